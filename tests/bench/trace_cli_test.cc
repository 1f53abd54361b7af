// `macrotask trace` as its users see it: what it prints, where, and its exit
// code.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "macrotask/trace_file.h"
#include "tests/bench/program.h"
#include "tests/bench/trace_example.h"

namespace bench {
namespace {

class TraceCli : public ProgramTest {
 protected:
  TraceCli() { macrotask::WriteTrace(ExampleTrace(), Path("run")); }

  // In the folder of the trace `run`.
  Outcome Run(const std::string& arguments) {
    return ProgramTest::Run("trace " + arguments);
  }
  void ExpectRejected(const std::string& arguments,
                      const std::string& sentence) {
    ProgramTest::ExpectRejected("trace " + arguments, sentence);
  }
};

TEST_F(TraceCli, PrintsAllReportsButChronUnlessToldOtherwise) {
  const Outcome outcome = Run("run");
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.error, "");
  for (const char* part :
       {"begun:", "\nTOTALS", "\nSYNC", "\nCPU", "\nSTATUS"}) {
    EXPECT_NE(outcome.out.find(part), std::string::npos) << part;
  }
  EXPECT_EQ(outcome.out.find("\nCHRON"), std::string::npos);
}

TEST_F(TraceCli, PrintsTheReportsAskedForInThatOrder) {
  const Outcome outcome = Run("--report status --report chron run");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.error;
  const auto status = outcome.out.find("\nSTATUS");
  const auto chron = outcome.out.find("\nCHRON");
  ASSERT_NE(status, std::string::npos);
  ASSERT_NE(chron, std::string::npos);
  EXPECT_LT(status, chron);
  EXPECT_EQ(outcome.out.find("\nTOTALS"), std::string::npos);
}

TEST_F(TraceCli, FiltersMayBeRepeated) {
  const Outcome outcome =
      Run("--csv - --task 2 --class EVENTS --class USERS --action BARSYNC "
          "--action \"user 70\" --task 1 run");
  EXPECT_EQ(outcome.error, "");
  EXPECT_EQ(outcome.out,
            "time_us,task,cpu,class,action,object,detail,data\n"
            "20.000,1,0,EVENTS,BARSYNC,barrier 3,2 tasks,8589934595\n"
            "29.000,2,1,EVENTS,BARSYNC,barrier 3,2 tasks,8589934595\n"
            "45.000,2,1,EVENTS,BARSYNC,barrier 3,2 tasks,8589934595\n"
            "50.000,1,0,EVENTS,BARSYNC,barrier 3,2 tasks,8589934595\n"
            "81.000,2,1,USERS,user 70,,0x5,5\n");
}

TEST_F(TraceCli, WritesFilesBesideTheReports) {
  const Outcome outcome =
      Run("run --csv run.csv --perfetto run.json --report cpu");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.error;
  EXPECT_NE(outcome.out.find("\nCPU"), std::string::npos);
  const std::string csv = ReadAll(Path("run.csv"));
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 27);
  EXPECT_TRUE(nlohmann::json::accept(ReadAll(Path("run.json"))));
}

TEST_F(TraceCli, PerfettoGoesToAPipeInsteadOfTheReports) {
  const Outcome outcome = Run("run --perfetto -");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.error;
  EXPECT_TRUE(nlohmann::json::accept(outcome.out));
}

TEST_F(TraceCli, UnknownNamesAreOneSentenceWithTheExpectedOnes) {
  ExpectRejected("run --report all",
                 "unknown --report 'all': expected one of chron, cpu, status, "
                 "sync, totals");
  ExpectRejected("run --class BARRIERS",
                 "unknown --class 'BARRIERS': expected one of CPUS, EVENTS, "
                 "INFO, LOCKS, TASKS, USERS");
  const Outcome outcome = Run("run --action BARSINK");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.error.find("macrotask: unknown --action 'BARSINK': "
                               "expected one of TSKSTART, "),
            0u);
}

TEST_F(TraceCli, BadOptionsAreOneLine) {
  for (const char* arguments : {"", "run --task one", "run --task -1",
                                "run more", "run --csv ''", "--report"}) {
    const Outcome outcome = Run(arguments);
    EXPECT_EQ(outcome.exit_code, 2) << arguments;
    EXPECT_EQ(outcome.out, "") << arguments;
    EXPECT_EQ(std::count(outcome.error.begin(), outcome.error.end(), '\n'), 1)
        << outcome.error;
  }
}

TEST_F(TraceCli, BadFilesAreOneSentenceAndNothingIsWritten) {
  const std::string bytes = macrotask::EncodeTrace(ExampleTrace());
  std::ofstream(Path("short")) << bytes.substr(0, 100);
  std::string other = bytes;
  other[8] = 2;
  std::ofstream(Path("other")) << other;
  std::ofstream(Path("text")) << "no trace\n";
  const std::string outputs = " --csv a.csv --perfetto a.json";
  ExpectRejected("none" + outputs,
                 "cannot read 'none': No such file or directory");
  ExpectRejected("." + outputs, "cannot read '.': Is a directory");
  ExpectRejected("short" + outputs,
                 "'short' is truncated: 100 bytes, expected " +
                     std::to_string(bytes.size()));
  ExpectRejected("other" + outputs,
                 "'other' has version 2 of the trace format: expected version "
                 "1");
  ExpectRejected("text" + outputs,
                 "'text' is no history trace: it does not begin with MTHISTRY");
}

TEST_F(TraceCli, BadOutputsAreOneSentenceAndNothingIsWritten) {
  ExpectRejected("run --csv x --perfetto x",
                 "--csv and --perfetto both write to 'x'");
  ExpectRejected("run --csv - --perfetto -",
                 "--csv and --perfetto both write to '-'");
  ExpectRejected("run --csv a.csv --perfetto none/x",
                 "cannot write 'none/x': No such file or directory");
  ExpectRejected("run --csv run", "'run' is the trace itself");
  EXPECT_EQ(macrotask::ReadTrace(Path("run")), ExampleTrace());
}

TEST_F(TraceCli, HelpSaysWhatTheFiltersDo) {
  const Outcome outcome = Run("--help");
  EXPECT_EQ(outcome.exit_code, 0);
  for (const char* part :
       {"MTDUMP", "--task", "--class", "--action", "still found among all"}) {
    EXPECT_NE(outcome.out.find(part), std::string::npos) << part;
  }
}

}  // namespace
}  // namespace bench
