#include "macrotask/barrier.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <deque>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "macrotask/task.h"
#include "tests/macrotask/support.h"

namespace macrotask {
namespace {

std::size_t Index(int i) { return static_cast<std::size_t>(i); }

using BarrierTest = ByPolicyAndTasks;

TEST_P(BarrierTest, NoTaskIsEverAPhaseAheadOrBehind) {
  Barrier barrier(num_tasks(), policy());
  EXPECT_EQ(barrier.num_tasks(), num_tasks());
  EXPECT_EQ(
      CountPhaseErrors(
          num_tasks(), num_rounds(), [&](int) { barrier.Sync(); }, policy()),
      0);
}

TEST_P(BarrierTest, CarriesWhatWasWrittenBothWays) {
  Barrier barrier(num_tasks(), policy());
  EXPECT_EQ(
      MixSlots(
          num_tasks(), num_rounds(), [&](int) { barrier.Sync(); }, policy()),
      MixedSlots(num_tasks(), num_rounds()));
}

// Two buffers used in turn need one barrier a phase, and only a barrier that is
// ready for the next phase at once.
TEST_P(BarrierTest, IsReusableAtOnce) {
  Barrier barrier(num_tasks(), policy());
  std::vector<int> buffers[2];
  for (auto& buffer : buffers) buffer.assign(Index(num_tasks()), -1);
  std::vector<int> errors(Index(num_tasks()), 0);
  RunTasks(
      num_tasks(),
      [&](int task) {
        for (int phase = 0; phase < num_rounds(); ++phase) {
          std::vector<int>& buffer = buffers[phase % 2];
          buffer[Index(task)] = phase;
          barrier.Sync();
          for (int seen : buffer) errors[Index(task)] += seen != phase;
        }
      },
      policy());
  EXPECT_EQ(errors, std::vector<int>(Index(num_tasks()), 0));
}

TEST_P(BarrierTest, SurvivesTheTasksThatLeaveItLast) {
  for (int round = 0; round < 50; ++round) {
    auto barrier = std::make_unique<Barrier>(num_tasks(), policy());
    RunTasks(
        num_tasks(), [&](int) { barrier->Sync(); }, policy());
    barrier.reset();
  }
}

INSTANTIATE_BY_POLICY_AND_TASKS(BarrierTest);

using CrossingBarriersTest = ByPolicy;

// 16 tasks as a 4 x 4 grid with a barrier for each row and each column: the
// maximum over the rows, then over the columns, is the maximum of all.
TEST_P(CrossingBarriersTest, RowsAndColumnsSpreadOneValueToAll) {
  constexpr int kSide = 4;
  std::deque<Barrier> rows;
  std::deque<Barrier> columns;
  for (int i = 0; i < kSide; ++i) {
    rows.emplace_back(kSide, GetParam());
    columns.emplace_back(kSide);
  }
  int values[kSide][kSide] = {};
  int of_row[kSide][kSide] = {};
  int num_errors[kSide][kSide] = {};
  RunTasks(
      kSide * kSide,
      [&](int task) {
        const int row = task / kSide;
        const int column = task % kSide;
        for (int round = 0; round < 50; ++round) {
          values[row][column] = (task + round) % (kSide * kSide) + 16 * round;
          rows[Index(row)].Sync();
          int most = 0;
          for (int value : values[row]) most = std::max(most, value);
          of_row[row][column] = most;
          columns[Index(column)].Sync();
          for (int i = 0; i < kSide; ++i)
            most = std::max(most, of_row[i][column]);
          num_errors[row][column] += most != 16 * round + 15;
          // Nobody writes of_row again before his column, or values before his row,
          // has read it.
          columns[Index(column)].Sync();
          rows[Index(row)].Sync();
        }
      },
      GetParam());
  for (const auto& row : num_errors) {
    for (int errors : row) EXPECT_EQ(errors, 0);
  }
}

INSTANTIATE_BY_POLICY(CrossingBarriersTest);

TEST(MixedPoliciesTest, BarriersOfEveryPolicyWorkSideBySide) {
  std::deque<Barrier> barriers;
  for (const WaitPolicy& policy : kAllPolicies)
    barriers.emplace_back(7, policy);
  std::vector<std::size_t> next(7, 0);
  EXPECT_EQ(
      CountPhaseErrors(
          7, 100, [&](int task) { barriers[next[Index(task)]++ % 3].Sync(); }),
      0);
}

TEST(BarrierConstructorTest, RefusesLessThanOneTaskInOneSentence) {
  for (int num_tasks : {0, -1}) {
    try {
      Barrier barrier(num_tasks);
      FAIL() << "a barrier of " << num_tasks;
    } catch (const std::invalid_argument& error) {
      EXPECT_EQ(error.what(), "a barrier needs at least 1 task, not " +
                                  std::to_string(num_tasks));
    }
  }
}

TEST(CountPhaseErrorsTest, CatchesABarrierThatHoldsNobody) {
  EXPECT_GT(CountPhaseErrors(4, 1000, [](int) {}), 0);
}

TEST(CountPhaseErrorsTest, CatchesABarrierThatSkipsEverySeventhPhase) {
  Barrier barrier(4);
  std::vector<CacheAligned<int>> num_syncs(4);
  EXPECT_GT(CountPhaseErrors(4, 700,
                             [&](int task) {
                               if (++*num_syncs[Index(task)] % 7 == 0) return;
                               barrier.Sync();
                             }),
            0);
}

}  // namespace
}  // namespace macrotask
