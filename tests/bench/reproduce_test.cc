// The paper's experiment, without a clock where a clock is not needed.

#include "bench/reproduce.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "bench/gains.h"
#include "bench/report.h"

namespace bench {
namespace {

const Reproduction& Once() {
  static const Reproduction reproduction = Reproduce({.repetitions = 1});
  return reproduction;
}

// The paper has 0.770 and 0.485.
TEST(Reproduce, AlgorithmicSpeedupsAreThePapers) {
  EXPECT_GT(StepSpeedup(Once(), 2), 0.70);
  EXPECT_LT(StepSpeedup(Once(), 2), 0.84);
  EXPECT_GT(StepSpeedup(Once(), 4), 0.44);
  EXPECT_LT(StepSpeedup(Once(), 4), 0.54);
}

TEST(Reproduce, EveryRowHasTheStatesOfTheSerialProgram) {
  ASSERT_EQ(Once().lanes.size(), 2u);
  for (const LaneTables& tables : Once().lanes) {
    EXPECT_GE(tables.rows.size(), kPaperTable2.size());
    for (const TableRow& row : tables.rows) EXPECT_TRUE(row.same_bits);
  }
}

TEST(Reproduce, OnlyRowsWithEnoughProcessorsAreMeasured) {
  for (const LaneTables& tables : Once().lanes) {
    for (const TableRow& row : tables.rows) {
      EXPECT_EQ(row.measured(), row.processors() <= Once().machine.processors);
    }
  }
}

TEST(Reproduce, LiftReachesTheTargetWithItsStartIncluded) {
  for (const LaneTables& tables : Once().lanes) {
    EXPECT_LT(tables.lift.error, kTargetError);
    EXPECT_EQ(tables.lift.seconds.size(), 1u);
  }
}

TEST(Table2Rows, AreThePapersInItsOrder) {
  const auto rows = Table2Rows(1, 4);
  ASSERT_EQ(rows.size(), kPaperTable2.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_EQ(rows[i].paper, &kPaperTable2[i]);
    EXPECT_EQ(rows[i].processors(), kPaperTable2[i].processors);
  }
}

TEST(Table2Rows, HaveTheMachinesOwnBehindTheSerialOnes) {
  const auto rows = Table2Rows(2, 4);
  ASSERT_EQ(rows.size(), kPaperTable2.size() + 5);
  const integrators::Partition own[] = {{1, 2}, {2, 1}, {1, 2}, {2, 1}, {2, 1}};
  const int blocks[] = {4, 4, 2, 2, 1};
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(rows[3 + i].paper, nullptr);
    EXPECT_EQ(rows[3 + i].partition.chain_tasks, own[i].chain_tasks);
    EXPECT_EQ(rows[3 + i].partition.integration_tasks,
              own[i].integration_tasks);
    EXPECT_EQ(rows[3 + i].block_size, blocks[i]);
  }
  // All partitions of four tasks are the paper's.
  EXPECT_EQ(Table2Rows(4, 4).size(), kPaperTable2.size());
}

TEST(Report, TextHasBothTablesAtBothWidths) {
  const std::string text = ReportText(Once());
  for (const char* part : {"Table 1", "Table 2", "4 lanes", "1 lane", "S_T",
                           "BARSYNC", "compiler:", "placement:"}) {
    EXPECT_NE(text.find(part), std::string::npos) << part;
  }
  if (Once().machine.processors < 8) {
    EXPECT_NE(text.find("needs 8 processors"), std::string::npos);
  }
}

TEST(Report, CsvHasOneRowForEveryRowAndWidth) {
  const std::string csv = ReportCsv(Once());
  const auto lines = std::count(csv.begin(), csv.end(), '\n');
  EXPECT_EQ(lines, 1 + 2 * static_cast<long>(Once().lanes[0].rows.size()));
}

TEST(Report, JsonHasEveryRawFigure) {
  const nlohmann::json json = nlohmann::json::parse(ReportJson(Once()));
  EXPECT_EQ(json["table2"].size(), 2 * Once().lanes[0].rows.size());
  EXPECT_EQ(json["table2"][0]["seconds"].size(), 1u);
  EXPECT_EQ(json["sweeps"][0]["points"].size(), Once().sweeps[0].points.size());
  EXPECT_EQ(json["machine"]["compiler"], Once().machine.compiler);
}

}  // namespace
}  // namespace bench
