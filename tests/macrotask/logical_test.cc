// What tasks that take turns on few pthreads do beyond what all policies do.

#include <gtest/gtest.h>

#include <atomic>
#include <iterator>
#include <numeric>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "macrotask/barrier.h"
#include "macrotask/event.h"
#include "macrotask/lock.h"
#include "macrotask/placement.h"
#include "macrotask/task.h"
#include "macrotask/task_list.h"
#include "macrotask/worker_pool.h"
#include "tests/macrotask/process.h"
#include "tests/macrotask/support.h"

namespace macrotask {
namespace {

constexpr int kManyTasks = 64;

TEST(LogicalTaskTest, ThereIsOnePthreadForEachProcessor) {
  std::vector<std::thread::id> pthreads(kManyTasks);
  RunTasks(
      kManyTasks,
      [&](int task) {
        pthreads[static_cast<std::size_t>(task)] = std::this_thread::get_id();
      },
      WaitPolicy::Logical());
  int num_changes = 0;
  for (int task = 1; task < kManyTasks; ++task) {
    const auto i = static_cast<std::size_t>(task);
    if (pthreads[i] != pthreads[i - 1]) ++num_changes;
  }
  EXPECT_EQ(num_changes, NumProcessors() - 1);  // neighbours are together
  EXPECT_EQ(pthreads[0], std::this_thread::get_id());
}

TEST(LogicalTaskTest, TestingALockThatANeighbourHoldsComesToAnEnd) {
  Lock lock(WaitPolicy::Logical());
  Barrier barrier(kManyTasks, WaitPolicy::Logical());
  long count = 0;
  RunTasks(
      kManyTasks,
      [&](int) {
        for (int i = 0; i < 20; ++i) {
          while (lock.Test()) {
          }
          ++count;
          lock.Off();
        }
        barrier.Sync();
      },
      WaitPolicy::Logical());
  EXPECT_EQ(count, 20L * kManyTasks);
}

TEST(LogicalTaskTest, TestingAnEventThatANeighbourPostsComesToAnEnd) {
  std::vector<Event> events(kManyTasks);
  RunTasks(
      kManyTasks,
      [&](int task) {
        if (task + 1 < kManyTasks) {
          while (!events[static_cast<std::size_t>(task) + 1].Test()) {
          }
        }
        events[static_cast<std::size_t>(task)].Post();
      },
      WaitPolicy::Logical());
  EXPECT_TRUE(events[0].Test());
}

// Two neighbours that always have something to do must not keep the arrival of
// a third from the tasks of other processors.
TEST(LogicalBarrierTest, ArrivalIsSeenThoughNeighboursAreNeverIdle) {
  if (NumProcessors() < 2) GTEST_SKIP() << "needs 2 processors";
  const int num_tasks = 3 * NumProcessors();
  Barrier ends(2, WaitPolicy::Logical());
  Event stop, ping, pong;
  RunTasks(
      num_tasks,
      [&](int task) {
        if (task == 0 || task == num_tasks - 1) {
          ends.Sync();
          if (task != 0) stop.Post();
          if (task != 0) ping.Post(), pong.Post();
        } else if (task == 1) {
          while (!stop.Test()) ping.Wait(), ping.Clear(), pong.Post();
          pong.Post();
        } else if (task == 2) {
          ping.Post();
          while (!stop.Test()) pong.Wait(), pong.Clear(), ping.Post();
          ping.Post();
        }
      },
      WaitPolicy::Logical());
}

TEST(LogicalBarrierTest, PthreadsThatAreNoLogicalTasksMayTakePart) {
  constexpr int kRounds = 50;
  Barrier barrier(5, WaitPolicy::Logical());
  std::atomic<int> rounds[5] = {};
  const auto run = [&](int index) {
    for (int round = 1; round <= kRounds; ++round) {
      rounds[index] = round;
      barrier.Sync();
      for (const auto& other : rounds) EXPECT_EQ(other, round);
      barrier.Sync();
    }
  };
  std::thread first(run, 3), second(run, 4);
  RunTasks(3, run, WaitPolicy::Logical());
  first.join();
  second.join();
}

TEST(LogicalTaskTest, KeepsTheExceptionThatItHandlesAcrossAWait) {
  Barrier barrier(kManyTasks, WaitPolicy::Logical());
  std::atomic<int> num_right = 0;
  RunTasks(
      kManyTasks,
      [&](int task) {
        try {
          throw std::runtime_error(std::to_string(task));
        } catch (const std::exception&) {
          barrier.Sync();
          try {
            throw;
          } catch (const std::exception& mine) {
            if (mine.what() == std::to_string(task)) ++num_right;
          }
        }
      },
      WaitPolicy::Logical());
  EXPECT_EQ(num_right, kManyTasks);
}

TEST(LogicalBarrierTest, MayBeOfAnyOtherPolicy) {
  std::vector<WaitPolicy> policies(std::begin(kAllPolicies),
                                   std::end(kAllPolicies));
  policies.push_back(WaitPolicy());
  for (const WaitPolicy& policy : policies) {
    Barrier barrier(kManyTasks, policy);
    EXPECT_EQ(CountPhaseErrors(
                  kManyTasks, 20, [&](int) { barrier.Sync(); },
                  WaitPolicy::Logical()),
              0)
        << Name(policy.kind);
  }
}

TEST(LogicalTaskTest, HasTheStackThatWasAskedFor) {
  constexpr std::size_t kLarge = std::size_t{8} << 20;
  WorkerPool::TheOne().SetStackSize(2 * kLarge);
  std::atomic<long> sum = 0;
  RunTasks(
      2 * NumProcessors(),
      [&](int) {
        volatile char large[kLarge];
        large[0] = 1;
        large[kLarge - 1] = 1;
        sum += large[0] + large[kLarge - 1];
      },
      WaitPolicy::Logical());
  WorkerPool::TheOne().SetStackSize(0);
  EXPECT_EQ(sum, 4L * NumProcessors());
}

TEST(LogicalTaskTest, IsListed) {
  const int num_tasks = 8 * NumProcessors();
  Barrier barrier(num_tasks, WaitPolicy::Logical());
  std::size_t num_listed = 0;
  RunTasks(
      num_tasks,
      [&](int task) {
        barrier.Sync();
        if (task == 0) num_listed = ListTasks().size();
        barrier.Sync();
      },
      WaitPolicy::Logical());
  EXPECT_GE(num_listed, static_cast<std::size_t>(num_tasks));
}

using LogicalDeadlockTest = InOwnProcess<testing::Test>;

TEST_F(LogicalDeadlockTest, IsFoundAfterTheFirstTasksOfAllPthreadsHaveEnded) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "LeakSanitizer takes what is on the stack of the pthread for "
                  "lost when a task on a stack of its own ends the program";
#endif
  const auto program = [] {
    static Event never(WaitPolicy::Logical());
    const int num_tasks = 3 * NumProcessors();
    RunTasks(
        num_tasks,
        [](int task) {
          if (task % 3 != 0) never.Wait();
        },
        WaitPolicy::Logical());
  };
  EXPECT_EXIT(program(), testing::ExitedWithCode(3),
              "waiting for event 1\n(.*\n)*Deadlock");
}

TEST(LogicalTaskTest, IsUsedAgainByLaterRuns) {
  long sum = 0;
  for (int run = 0; run < 200; ++run) {
    std::vector<int> values(16);
    RunTasks(
        16, [&](int task) { values[static_cast<std::size_t>(task)] = task; },
        WaitPolicy::Logical());
    sum += std::accumulate(values.begin(), values.end(), 0L);
  }
  EXPECT_EQ(sum, 200L * 120);
}

}  // namespace
}  // namespace macrotask
