#include "macrotask/epoch.h"

#include <gtest/gtest.h>

#include <atomic>
#include <memory>

#include "macrotask/task.h"
#include "tests/macrotask/support.h"

namespace macrotask {
namespace {

using EpochTest = ByPolicy;

TEST_P(EpochTest, AwaitReturnsAtOnceIfPassedSeveralTimes) {
  Epoch epoch;
  const std::uint64_t seen = epoch.Read();
  epoch.Advance();
  epoch.Advance();
  epoch.AwaitPast(seen, GetParam());
  EXPECT_EQ(epoch.Read(), seen + 2);
}

TEST_P(EpochTest, AdvanceIfKeepsANumberOfTheOtherParity) {
  Epoch epoch;
  epoch.AdvanceIfOdd();
  EXPECT_EQ(epoch.Read(), 0u);
  epoch.AdvanceIfEven();
  epoch.AdvanceIfEven();
  EXPECT_EQ(epoch.Read(), 1u);
  epoch.AdvanceIfOdd();
  EXPECT_EQ(epoch.Read(), 2u);
}

// Each task advances one epoch and waits for the other.
TEST_P(EpochTest, AdvanceToWakesWhoeverWaitsForTheNextOne) {
  constexpr std::uint64_t kNumEpochs = 500;
  Epoch epochs[2];
  RunTasks(
      2,
      [&](int task) {
        for (std::uint64_t epoch = 1; epoch <= kNumEpochs; ++epoch) {
          epochs[task].AdvanceTo(epoch);
          epochs[1 - task].AwaitPast(epoch - 1, GetParam());
        }
      },
      GetParam());
  for (const Epoch& epoch : epochs) EXPECT_EQ(epoch.Read(), kNumEpochs);
}

TEST_P(EpochTest, ReleasedTaskMayDestroyIt) {
  for (int round = 0; round < 1000; ++round) {
    auto epoch = std::make_unique<Epoch>();
    Epoch& alias = *epoch;
    RunTasks(
        2,
        [&](int task) {
          if (task == 0) {
            alias.Advance();
          } else {
            alias.AwaitPast(0, GetParam());
            epoch.reset();
          }
        },
        GetParam());
  }
}

// Waiters of two policies, each at an epoch of its own.
TEST_P(EpochTest, EveryWaiterLeavesAfterTheEpochItSaw) {
  constexpr int kNumTasks = 7;
  constexpr std::uint64_t kNumEpochs = 500;
  Epoch epoch;
  std::atomic<int> num_early = 0;
  RunTasks(
      kNumTasks,
      [&](int task) {
        if (task == 0) {
          for (std::uint64_t i = 0; i < kNumEpochs; ++i) epoch.Advance();
          return;
        }
        const WaitPolicy policy =
            task % 2 == 0 ? GetParam() : WaitPolicy::Block();
        std::uint64_t seen = epoch.Read();
        while (seen < kNumEpochs) {
          epoch.AwaitPast(seen, policy);
          const std::uint64_t now = epoch.Read();
          num_early += now <= seen;
          seen = now;
        }
      },
      GetParam());
  EXPECT_EQ(num_early, 0);
  EXPECT_EQ(epoch.Read(), kNumEpochs);
}

TEST_P(EpochTest, AdvancesOfSeveralTasksAllCount) {
  Epoch epoch;
  RunTasks(
      4,
      [&](int task) {
        if (task == 0) {
          for (std::uint64_t seen = 0; seen < 1500; ++seen) {
            epoch.AwaitPast(seen, GetParam());
          }
        } else {
          for (int i = 0; i < 500; ++i) epoch.Advance();
        }
      },
      GetParam());
  EXPECT_EQ(epoch.Read(), 1500u);
}

INSTANTIATE_BY_POLICY(EpochTest);

}  // namespace
}  // namespace macrotask
