#include "macrotask/busy_time.h"

#include <gtest/gtest.h>

#include <chrono>
#include <numeric>
#include <string>
#include <thread>
#include <vector>

#include "macrotask/event.h"
#include "macrotask/placement.h"
#include "macrotask/task.h"
#include "macrotask/task_list.h"
#include "tests/macrotask/support.h"

namespace macrotask {
namespace {

using Clock = std::chrono::steady_clock;
constexpr auto kAWhile = std::chrono::milliseconds(20);

void KeepBusy() {
  const auto begin = Clock::now();
  while (Clock::now() - begin < kAWhile) {
  }
}

// Lets `num_tasks` tasks, of `policy`, wait for the length of `body()`.
template <typename Body>
void WithWaitingTasks(int num_tasks, const WaitPolicy& policy,
                      const Body& body) {
  Event over(policy);
  RunTasks(
      num_tasks + 1,
      [&](int task) {
        if (task != 0) return over.Wait();
        const auto num_waiting = [] {
          int number = 0;
          for (const TaskStatus& status : ListTasks()) {
            number += status.state == TaskState::kWaiting;
          }
          return number;
        };
        YieldUntil([&] { return num_waiting() == num_tasks; });
        KeepBusy();  // They look for a deadlock, and then sleep.
        body();
        over.Post();
      },
      WaitPolicy::Hold());
}

// How the busy times grow while `body()` runs, and how long that takes.
struct Growth {
  std::vector<double> times;
  double elapsed_at_least, elapsed_at_most;
  double sum() const {
    return std::accumulate(times.begin(), times.end(), 0.0);
  }
};

template <typename Body>
Growth GrowthDuring(const Body& body) {
  Growth growth;
  const auto seconds = [](Clock::duration time) {
    return std::chrono::duration<double>(time).count();
  };
  const auto first = Clock::now();
  const std::vector<double> before = BusyTimes();
  const auto begin = Clock::now();
  body();
  const auto end = Clock::now();
  growth.times = BusyTimes();
  const auto last = Clock::now();
  for (std::size_t i = 0; i < before.size(); ++i) growth.times[i] -= before[i];
  growth.elapsed_at_least = seconds(end - begin);
  growth.elapsed_at_most = seconds(last - first);
  return growth;
}

// Of sums of doubles of less than some hours.
constexpr double kRounding = 1e-9;

using BusyTimesTest = ByPolicyAndTasks;

TEST_P(BusyTimesTest, AddUpToTheTimeThatPasses) {
  const Growth growth = GrowthDuring([&] {
    for (int round = 0; round < 20; ++round) {
      Event posted(policy());
      RunTasks(
          num_tasks(),
          [&](int task) {
            if (task == num_tasks() - 1) posted.Post();
            posted.Wait();
          },
          policy());
    }
  });
  EXPECT_EQ(growth.times.size(), static_cast<std::size_t>(NumProcessors()) + 1);
  for (const double time : growth.times) EXPECT_GE(time, -kRounding);
  EXPECT_GE(growth.sum(), growth.elapsed_at_least - kRounding);
  EXPECT_LE(growth.sum(), growth.elapsed_at_most + kRounding);
}

INSTANTIATE_BY_POLICY_AND_TASKS(BusyTimesTest);

TEST(BusyTimesOfOneTest, AloneItKeepsOneProcessorBusy) {
  const Growth growth = GrowthDuring(KeepBusy);
  EXPECT_NEAR(growth.times[1], growth.sum(), kRounding);
}

TEST(BusyTimesOfOneTest, TasksThatSleepKeepNoProcessorBusy) {
  WithWaitingTasks(4, WaitPolicy::Block(), [] {
    const Growth growth = GrowthDuring(KeepBusy);
    EXPECT_NEAR(growth.times[1], growth.sum(), kRounding);
  });
}

TEST(BusyTimesOfOneTest, TasksThatSpinKeepTheirProcessorsBusy) {
  WithWaitingTasks(NumProcessors() + 3, WaitPolicy::Spin(), [] {
    const Growth growth = GrowthDuring(KeepBusy);
    EXPECT_NEAR(growth.times.back(), growth.sum(), kRounding);
  });
}

// A pthread of the program's own is a task once it has waited.
TEST(BusyTimesOfOneTest, AForeignPthreadThatSleepsTakesNothingFromOthers) {
  Event over(WaitPolicy::Block());
  std::thread foreign([&] { over.Wait(); });
  const auto waits = [] {
    for (const TaskStatus& task : ListTasks()) {
      if (task.state == TaskState::kWaiting) return true;
    }
    return false;
  };
  YieldUntil(waits);
  KeepBusy();  // It looks for a deadlock, and then sleeps.
  const Growth growth = GrowthDuring(KeepBusy);
  over.Post();
  foreign.join();
  EXPECT_NEAR(growth.times[1], growth.sum(), kRounding);
  const Growth afterwards = GrowthDuring(KeepBusy);
  EXPECT_NEAR(afterwards.times[1], afterwards.sum(), kRounding);
}

TEST(BusyTimesTextTest, IsATableWithTotalAndConcurrency) {
  EXPECT_EQ(ToString({0.5, 1.5, 2.0}),
            "  processors busy     seconds   share\n"
            "                0    0.500000   12.5 %\n"
            "                1    1.500000   37.5 %\n"
            "                2    2.000000   50.0 %\n"
            "  total              4.000000\n"
            "  average concurrency 1.38\n");
}

TEST(BusyTimesTextTest, DividesNothingByZero) {
  EXPECT_EQ(ToString({0, 0}),
            "  processors busy     seconds   share\n"
            "                0    0.000000    0.0 %\n"
            "                1    0.000000    0.0 %\n"
            "  total              0.000000\n"
            "  average concurrency 0.00\n");
}

}  // namespace
}  // namespace macrotask
