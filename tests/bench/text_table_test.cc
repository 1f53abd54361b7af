#include "bench/text_table.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace bench {
namespace {

TextTable Example() {
  TextTable table({"a", "long one"});
  table.AddRow({"12345", "x"});
  return table;
}

TEST(TextTable, PrintsAlignedMarkdown) {
  EXPECT_EQ(Example().Markdown(),
            "| a     | long one |\n"
            "| ----- | -------- |\n"
            "| 12345 | x        |\n");
}

TEST(TextTable, QuotesWhatCsvMustQuote) {
  TextTable table = Example();
  table.AddRow({"1,2", "say \"hi\""});
  EXPECT_EQ(table.Csv(), "a,long one\n12345,x\n\"1,2\",\"say \"\"hi\"\"\"\n");
}

TEST(TextTable, RowOfAnotherLengthThrows) {
  TextTable table = Example();
  EXPECT_THROW(table.AddRow({"1"}), std::invalid_argument);
}

}  // namespace
}  // namespace bench
