// macrotask sync as its users see it, with as little measuring as possible.

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/bench/program.h"

namespace bench {
namespace {

class SyncCli : public ProgramTest {
 protected:
  struct Told {
    int exit_code;
    std::string text;  // both outputs
  };

  Told RunSync(const std::string& arguments, const std::string& before = "") {
    // LeakSanitizer cannot walk the stacks of parked tasks.
    const Outcome outcome =
        Run("sync " + arguments, "ASAN_OPTIONS=detect_leaks=0 " + before);
    return {outcome.exit_code, outcome.out + outcome.error};
  }
};

bool Has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

constexpr const char* kShort = " --repetitions 1 --tasks 2 --work 0";

TEST_F(SyncCli, MeasuresEveryFamily) {
  const Told outcome = RunSync(kShort);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.text;
  for (const char* row :
       {"| BARSYNC ", "| EVPOST to EVWAIT ", "| LOCKON + LOCKOFF ",
        "| LOCKTEST, set ", "| TSKSTART + TSKWAIT, after a rest ",
        "| pthread_barrier_t ", "| std::barrier ", "| libgomp ", "| libomp ",
        "| bare pairwise flags ", "| cache line there and back "}) {
    EXPECT_TRUE(Has(outcome.text, row)) << row << "\n" << outcome.text;
  }
}

TEST_F(SyncCli, MeasuresMoreTasksThanProcessors) {
  const Told outcome =
      RunSync("--repetitions 1 --tasks 4 --work 0 --constructs barrier,event");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.text;
  EXPECT_TRUE(Has(outcome.text, "| BARSYNC ")) << outcome.text;
}

TEST_F(SyncCli, WritesJson) {
  const Told outcome =
      RunSync("--constructs limit --repetitions 1 --placement free --json -");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.text;
  const auto json = nlohmann::json::parse(outcome.text);
  EXPECT_EQ(json["context"]["placement"], "free");
  EXPECT_FALSE(json["benchmarks"].empty());
}

TEST_F(SyncCli, LateArriverIsARowOfItsOwn) {
  const Told outcome =
      RunSync("--constructs barrier --wait hold --skew zero,late --csv -" +
              std::string(kShort));
  EXPECT_TRUE(Has(outcome.text, "barrier,BARSYNC,hold,2,0,late,"))
      << outcome.text;
  EXPECT_TRUE(Has(outcome.text, "barrier,BARSYNC,hold,2,0,zero,"))
      << outcome.text;
}

TEST_F(SyncCli, MeasuresWhatOneProcessorCan) {
  const Told outcome =
      RunSync("--constructs barrier,limit --wait block" + std::string(kShort),
              "taskset -c 0 ");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.text;
  EXPECT_TRUE(Has(outcome.text, "| needs 2 processors ")) << outcome.text;
}

TEST_F(SyncCli, CalibratesTheHoldTime) {
  const Told outcome = RunSync("--calibrate --repetitions 2");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.text;
  EXPECT_TRUE(Has(outcome.text, "CALL TSKTUNE('HOLDTIME', ")) << outcome.text;
}

TEST_F(SyncCli, WhatComparesTwoTasksNeedsTwoProcessors) {
  for (const std::string option : {"--break-even", "--calibrate"}) {
    const Told outcome = RunSync(option, "taskset -c 0 ");
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_EQ(outcome.text,
              "macrotask: " + option +
                  " needs 2 processors: this process may use 1\n");
  }
}

TEST_F(SyncCli, BadInputIsOneSentenceAndExitCodeTwo) {
  for (const char* arguments :
       {"--wait never", "--wait ''", "--tasks 0", "--tasks two", "--tasks 1000",
        "--work -1", "--work x", "--skew early", "--placement here",
        "--constructs mutex", "--constructs barrier --tasks 1",
        "--constructs barrier,mutex", "--repetitions 0", "--hold-time -1",
        "--csv x --json x", "--csv /none/x", "--calibrate --break-even",
        "--calibrate --csv x", "--barrier"}) {
    const Told outcome = RunSync(arguments);
    EXPECT_EQ(outcome.exit_code, 2) << arguments;
    EXPECT_TRUE(outcome.text.starts_with("macrotask: ")) << outcome.text;
    EXPECT_EQ(std::count(outcome.text.begin(), outcome.text.end(), '\n'), 1)
        << outcome.text;
  }
}

}  // namespace
}  // namespace bench
