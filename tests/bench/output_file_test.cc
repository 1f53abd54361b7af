#include "bench/output_file.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>

namespace bench {
namespace {

namespace fs = std::filesystem;

class OutputFile : public testing::Test {
 protected:
  OutputFile()
      : folder_(fs::path(testing::TempDir()) /
                ("output_file_test" + std::to_string(getpid()))) {
    fs::create_directories(folder_);
  }
  ~OutputFile() override { fs::remove_all(folder_); }

  std::string Path(const std::string& name) const { return folder_ / name; }
  static std::string Read(const std::string& path) {
    std::ifstream file(path);
    return std::string(std::istreambuf_iterator<char>(file), {});
  }
  int NumFiles() const {
    return static_cast<int>(std::distance(fs::directory_iterator(folder_),
                                          fs::directory_iterator()));
  }

  fs::path folder_;
};

TEST_F(OutputFile, IsWrittenWholeAndReplacesTheOldOne) {
  WriteOutput(Path("a.csv"), "one\n");
  WriteOutput(Path("a.csv"), "two\n");
  EXPECT_EQ(Read(Path("a.csv")), "two\n");
  EXPECT_EQ(NumFiles(), 1);
}

TEST_F(OutputFile, CheckingLeavesNothingBehindAndHarmsNothing) {
  WriteOutput(Path("a.csv"), "one\n");
  CheckOutput(Path("a.csv"));
  CheckOutput(Path("b.csv"));
  EXPECT_EQ(Read(Path("a.csv")), "one\n");
  EXPECT_EQ(NumFiles(), 1);
}

TEST_F(OutputFile, UnwritablePathIsNamedWithTheReason) {
  const std::string path = Path("none/a.csv");
  for (const auto write : {+[](const std::string& p) { CheckOutput(p); },
                           +[](const std::string& p) { WriteOutput(p, ""); }}) {
    try {
      write(path);
      ADD_FAILURE();
    } catch (const std::runtime_error& error) {
      EXPECT_EQ(error.what(),
                "cannot write '" + path + "': No such file or directory");
    }
  }
  EXPECT_THROW(CheckOutput(""), std::runtime_error);
}

TEST_F(OutputFile, FolderInItsPlaceStays) {
  fs::create_directories(Path("folder"));
  EXPECT_THROW(WriteOutput(Path("folder"), "x"), std::runtime_error);
  EXPECT_EQ(NumFiles(), 1);
}

}  // namespace
}  // namespace bench
