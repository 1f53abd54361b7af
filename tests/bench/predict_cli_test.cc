// macrotask predict and macrotask tune, as their users see them.

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/bench/program.h"

namespace bench {
namespace {

constexpr const char* kCray =
    " --machine '" SOURCE_DIR "/bench/machines/cray-ymp8-864.json'";

class PredictCli : public ProgramTest {
 protected:
  // LeakSanitizer cannot walk the stacks of parked tasks.
  Outcome RunQuietly(const std::string& arguments) {
    return Run(arguments, "ASAN_OPTIONS=detect_leaks=0 ");
  }

  void Write(const std::string& name, const std::string& text) {
    std::ofstream(Path(name)) << text;
  }
};

bool Has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST_F(PredictCli, HasThePapersTablesForTheCray) {
  const Outcome outcome =
      RunQuietly("predict" + std::string(kCray) + " --processors 1,4,8");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.error;
  for (const char* part :
       {"CRAY Y-MP8/864", "S_p", "S_T", "critical path", "work bound",
        "free sync", "imbalance %", "paper S_p", "| B2PC5  | 4   | 2   |",
        "so says the rule"}) {
    EXPECT_TRUE(Has(outcome.out, part)) << part << "\n" << outcome.out;
  }
}

TEST_F(PredictCli, ComparesTheCrayWithThePaper) {
  const Outcome outcome = RunQuietly("predict --validate" + std::string(kCray));
  EXPECT_EQ(outcome.exit_code, 0) << outcome.error;
  EXPECT_TRUE(Has(outcome.out, "Goal: within 5 % of the paper."))
      << outcome.out;
  EXPECT_TRUE(Has(outcome.out, ": met")) << outcome.out;
}

TEST_F(PredictCli, PrintsTheSameTwice) {
  const std::string arguments =
      "predict" + std::string(kCray) + " --processors 4 --seed 7";
  const Outcome first = RunQuietly(arguments);
  EXPECT_EQ(first.exit_code, 0);
  EXPECT_EQ(first.out, RunQuietly(arguments).out);
}

TEST_F(PredictCli, WritesARowForEveryConfiguration) {
  const Outcome outcome = RunQuietly("predict" + std::string(kCray) +
                                     " --processors 1,2,4,8,16,64 --csv -");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.error;
  // Header; 3 serial ones; 2 + 2 + 1, 3 + 2 + 1, 2 + 1 + 1, 3, 3.
  EXPECT_EQ(std::count(outcome.out.begin(), outcome.out.end(), '\n'),
            1 + 3 + 5 + 6 + 4 + 3 + 3)
      << outcome.out;
}

TEST_F(PredictCli, MeasuresThisMachineIntoAFileThatItReads) {
  const Outcome measured = RunQuietly(
      "predict --processors 2 --method B2PC5 --replications 3 "
      "--write-machine here.json");
  if (Has(measured.error, "takes 2 processors")) GTEST_SKIP();
  EXPECT_EQ(measured.exit_code, 0) << measured.error;
  const auto json = nlohmann::json::parse(ReadAll(Path("here.json")));
  EXPECT_TRUE(json["lanes"].contains("1"));
  EXPECT_TRUE(json["lanes"].contains("4"));
  EXPECT_TRUE(json["conditions"][0]["waits"].contains("logical"));
  const Outcome read = RunQuietly(
      "predict --machine here.json --processors 2,32 "
      "--method B8PC9,B2PC5 --replications 3");
  EXPECT_EQ(read.exit_code, 0) << read.error;
  EXPECT_TRUE(Has(read.out, "| B8PC9 ")) << read.out;
}

TEST_F(PredictCli, PredictsAProgramFromItsTrace) {
  EXPECT_EQ(Run("simulate --method B2PC5 --step 0.02 --integration-tasks 2 "
                "--trace run.trace")
                .exit_code,
            0);
  const Outcome outcome = RunQuietly("predict --trace run.trace" +
                                     std::string(kCray) + " --processors 1,2");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.error;
  EXPECT_TRUE(Has(outcome.out, "| processors | T (ms)")) << outcome.out;
}

TEST_F(PredictCli, RejectsBadInputInOneSentence) {
  ExpectRejected("predict --method B4PC3" + std::string(kCray),
                 "unknown method 'B4PC3': expected B1PC5, B2PC5, B4PC5, or "
                 "another B<b>PC<k> with k > b");
  ExpectRejected("predict --machine nowhere.json",
                 "cannot read 'nowhere.json': No such file or directory");
  ExpectRejected("predict --trace nowhere.trace" + std::string(kCray),
                 "cannot read 'nowhere.trace': No such file or directory");
  ExpectRejected("predict --lanes 4" + std::string(kCray),
                 "machine 'CRAY Y-MP8/864, UNICOS 6.0' has no costs for 4 "
                 "lanes: expected one of 1");
  ExpectRejected("predict --wait spin --processors 4" + std::string(kCray),
                 "machine 'CRAY Y-MP8/864, UNICOS 6.0' has no costs for the "
                 "way to wait 'spin': expected one of hold");
}

TEST_F(PredictCli, RejectsAMachineWithImpossibleFigures) {
  Write("bad.json",
        R"({"format": "macrotask machine 1", "name": "x", "processors": 0,
            "lanes": {}, "conditions": []})");
  const Outcome outcome = Run("predict --machine bad.json");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.out, "");
  EXPECT_TRUE(Has(outcome.error, "processors: expected a whole number"))
      << outcome.error;
}

TEST_F(PredictCli, TunesAndSimulateTakesTheWinner) {
  const Outcome tuned =
      RunQuietly("tune --method B2PC5 --repetitions 2 --write best");
  if (Has(tuned.error, "takes 2 processors")) GTEST_SKIP();
  EXPECT_EQ(tuned.exit_code, 0) << tuned.error;
  EXPECT_TRUE(Has(tuned.out, "The paper's rule")) << tuned.out;
  const Outcome simulated = Run("simulate $(cat best)");
  EXPECT_EQ(simulated.exit_code, 0) << simulated.error;
  EXPECT_TRUE(Has(simulated.out, "error:")) << simulated.out;
}

}  // namespace
}  // namespace bench
