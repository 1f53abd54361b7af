// The program as its users see it: what it prints, where, and its exit code.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "tests/bench/program.h"

namespace bench {
namespace {

using Cli = ProgramTest;

struct BreakdownTable {
  std::string constructs;                 // "all m^ EVWAIT"
  std::vector<std::vector<double>> rows;  // without the name
};

// The table in the output of --breakdown.
BreakdownTable ReadBreakdown(const std::string& out) {
  BreakdownTable table;
  std::istringstream lines(out);
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("|") || line.starts_with("| ---")) continue;
    std::istringstream cells(line.substr(2));
    std::vector<double> row;
    std::string cell;
    std::getline(cells, cell, '|');
    const bool header = cell.starts_with("task");
    while (std::getline(cells, cell, '|')) {
      if (!header) {
        row.push_back(std::stod(cell));
      } else if (const auto end = cell.find(" imbalance");
                 end != std::string::npos) {
        const auto open = cell.find('(');
        table.constructs +=
            (table.constructs.empty() ? "" : " ") +
            (open == std::string::npos
                 ? cell.substr(1, end - 1)
                 : cell.substr(open + 1, cell.find(')') - open - 1));
      }
    }
    if (!header) table.rows.push_back(row);
  }
  return table;
}

TEST_F(Cli, BadInputIsOneSentenceAndExitCodeTwo) {
  ExpectRejected("simulate --step 0.03",
                 "the step of 0.03 s does not divide the duration of 1 s");
  ExpectRejected("simulate --chain-tasks 5",
                 "5 chain tasks: expected 1 to 4, the number of chains");
  ExpectRejected("simulate --method B2PC5 --integration-tasks 3",
                 "3 integration tasks: expected 1 to 2, the points of a block "
                 "of B2PC5");
  ExpectRejected("simulate --method RK4",
                 "unknown method 'RK4': expected B1PC5, B2PC5, B4PC5, or "
                 "another B<b>PC<k> with k > b");
  ExpectRejected("simulate --figure serial --chain-tasks 2",
                 "serial has one task: got 2 chain tasks and 1 integration "
                 "tasks");
  ExpectRejected("simulate --chains 0", "0 chains: expected 1 to 10000");
  ExpectRejected("simulate --step 0.25", "4 steps: B1PC5 needs at least 5");
  ExpectRejected("simulate --method B1PC2 --step 0.5",
                 "2 steps: the lift is planned in at least 5");
  ExpectRejected("simulate --method B1PC40",
                 "method 'B1PC40': its coefficients do not fit 64-bit "
                 "fractions");
  ExpectRejected("simulate --figure 2",
                 "unknown --figure '2': expected one of figure2, figure3, "
                 "figure7, figure8, serial");
  ExpectRejected("simulate --wait never",
                 "unknown --wait 'never': expected one of auto, block, hold, "
                 "logical, spin");
  ExpectRejected("reproduce --csv x --json x",
                 "--csv and --json both write to 'x'");
  ExpectRejected("simulate --breakdown --trace x",
                 "--trace excludes --breakdown");
  ExpectRejected("simulate --breakdown --output x",
                 "--output excludes --breakdown");
  ExpectRejected("simulate --repetitions 3",
                 "--repetitions requires --breakdown");
  ExpectRejected("simulate --breakdown --chain-tasks 4 --step 0.000001",
                 "--breakdown of 4 tasks with 1000001 blocks each: expected at "
                 "most 1677721 blocks of all tasks");
  ExpectRejected("simulate --output /tmp",
                 "cannot write '/tmp': Is a directory");
  ExpectRejected("simulate --output /none/x.csv",
                 "cannot write '/none/x.csv': No such file or directory");
}

TEST_F(Cli, BadOptionsNameTheOption) {
  for (const char* arguments :
       {"", "simulat", "simulate --stepp 1", "simulate --wait never",
        "simulate --lanes 3", "simulate --step x", "reproduce --hold-time -1",
        "reproduce --repetitions 0"}) {
    const Outcome outcome = Run(arguments);
    EXPECT_EQ(outcome.exit_code, 2) << arguments;
    EXPECT_EQ(outcome.out, "") << arguments;
    EXPECT_EQ(std::count(outcome.error.begin(), outcome.error.end(), '\n'), 1)
        << outcome.error;
  }
}

TEST_F(Cli, RejectedRunWritesNoFile) {
  const fs::path path = Path("trajectory.csv");
  Run("simulate --step 0.03 --output " + path.string());
  EXPECT_FALSE(fs::exists(path));
  EXPECT_EQ(NumFiles(), 2);
}

TEST_F(Cli, TrajectoryHasARowForEveryGridPoint) {
  const fs::path path = Path("trajectory.csv");
  const Outcome outcome = Run("simulate --step 0.02 --output " + path.string());
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_NE(outcome.out.find("real-time factor"), std::string::npos);
  EXPECT_NE(outcome.out.find("drift of grips"), std::string::npos);
  const std::string csv = ReadAll(path);
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 52);
  EXPECT_EQ(csv.find("nan"), std::string::npos);
  // t, 13 of the member, and 6 x (q, qd, tau, f) of four chains.
  const std::string header = csv.substr(0, csv.find('\n'));
  EXPECT_EQ(std::count(header.begin(), header.end(), ','), 13 + 4 * 24);
}

TEST_F(Cli, TrajectoryGoesToAPipe) {
  const Outcome outcome = Run("simulate --step 0.02 --output -");
  EXPECT_EQ(outcome.out.substr(0, 2), "t,");
  EXPECT_EQ(outcome.error, "");
}

TEST_F(Cli, DeviceIsWrittenToAndNotReplaced) {
  EXPECT_EQ(Run("simulate --step 0.02 --output /dev/null").exit_code, 0);
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

// Two processors or one, the trajectory is the same to the last digit.
TEST_F(Cli, NumberOfProcessorsDoesNotChangeTheTrajectory) {
  const std::string arguments =
      "simulate --method B4PC5 --step 0.02 --chain-tasks 2 "
      "--integration-tasks 2 --output -";
  const Outcome all = Run(arguments);
  const Outcome one = Run(arguments, "taskset -c 0 ");
  EXPECT_EQ(one.exit_code, 0) << one.error;
  EXPECT_EQ(all.out, one.out);
}

TEST_F(Cli, AllFiguresAndPoliciesRun) {
  for (const char* arguments :
       {"--figure serial", "--figure figure2 --chain-tasks 2",
        "--figure figure3 --chain-tasks 4 --wait block",
        "--figure figure7 --method B4PC5 --integration-tasks 2 --wait spin",
        "--method B4PC6 --chain-tasks 2 --integration-tasks 2 --lanes 1",
        "--chains 2 --start plan", "--rotor-inertia --hold-time 0"}) {
    const Outcome outcome =
        Run("simulate --step 0.02 " + std::string(arguments));
    EXPECT_EQ(outcome.exit_code, 0) << arguments << outcome.error;
    EXPECT_EQ(outcome.error, "") << arguments;
  }
}

// Every task has a row, a column for every construct of the figure, and a sum
// that is its wall time but for a few clock readings and, where tasks share
// processors, the moment at which they are let go.
TEST_F(Cli, BreakdownAddsUpToTheWallTime) {
  struct Case {
    const char* arguments;
    int num_tasks;
    const char* constructs;
  };
  for (const Case& c : {
           Case{"--figure serial", 1, ""},
           Case{"--figure figure2 --chain-tasks 2", 2, "all m^ EVWAIT"},
           Case{"--figure figure3 --chain-tasks 4 --wait block", 4, "all m^"},
           Case{"--figure figure7 --method B4PC5 --integration-tasks 4 "
                "--wait logical --start plan",
                4, "all p^ EVWAIT"},
           Case{"--method B2PC5 --chain-tasks 2 --integration-tasks 2", 4,
                "all m^ p^ EVWAIT"},
           Case{"--chain-tasks 2 --wait logical --lanes 1", 2, "all m^"},
           Case{"", 1, ""},
       }) {
    const Outcome outcome =
        Run("simulate --step 0.02 --breakdown --repetitions 6 " +
            std::string(c.arguments));
    EXPECT_EQ(outcome.exit_code, 0) << c.arguments << outcome.error;
    EXPECT_EQ(outcome.error, "") << c.arguments;
    EXPECT_NE(outcome.out.find("disturbance: "), std::string::npos);
    const BreakdownTable table = ReadBreakdown(outcome.out);
    EXPECT_EQ(table.constructs, c.constructs) << outcome.out;
    ASSERT_EQ(table.rows.size(), static_cast<std::size_t>(c.num_tasks) + 1);
    for (const std::vector<double>& row : table.rows) {
      double sum = 0;  // of all between the wall time and the sum
      for (std::size_t i = 1; i + 2 < row.size(); ++i) sum += row[i];
      EXPECT_NEAR(sum, row[row.size() - 2],
                  0.01 * static_cast<double>(row.size()))
          << outcome.out;
      EXPECT_NEAR(row[0], row[row.size() - 2] + row.back(), 0.02);
      EXPECT_GE(row.back(), -0.05 * row[0]) << outcome.out;
    }
  }
}

TEST_F(Cli, HelpAndVersionExitWithZero) {
  for (const char* arguments :
       {"--help", "--version", "reproduce --help", "simulate --help"}) {
    const Outcome outcome = Run(arguments);
    EXPECT_EQ(outcome.exit_code, 0) << arguments;
    EXPECT_NE(outcome.out, "") << arguments;
  }
}

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define UNDER_SANITIZER 1
#else
#define UNDER_SANITIZER 0
#endif

// As root, no limit on the number of threads holds; one on the memory that
// their stacks take does.
TEST_F(Cli, MoreTasksThanTheSystemAllowsIsOneSentence) {
  if (UNDER_SANITIZER) GTEST_SKIP() << "sanitizers need the memory";
  const Outcome outcome =
      Run("simulate --chains 200 --chain-tasks 200 --step 0.1 --wait hold",
          "ulimit -v 400000; ");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(outcome.error.find("macrotask: cannot start 200 tasks"), 0u)
      << outcome.error;
}

TEST_F(Cli, MoreStacksThanThereIsMemoryForIsOneSentence) {
  if (UNDER_SANITIZER) GTEST_SKIP() << "sanitizers need the memory";
  const Outcome outcome =
      Run("simulate --chains 200 --chain-tasks 200 --step 0.1 --wait logical",
          "ulimit -v 120000; ");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(outcome.error.find("macrotask: cannot start 200 tasks with "), 0u)
      << outcome.error;
}

}  // namespace
}  // namespace bench
