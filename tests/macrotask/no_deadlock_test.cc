// Where the search for deadlocks must keep quiet. An alarm would end this
// program with exit code 3.

#include <gtest/gtest.h>
#include <poll.h>
#include <sys/time.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <deque>
#include <memory>
#include <thread>
#include <vector>

#include "macrotask/barrier.h"
#include "macrotask/deadlock.h"
#include "macrotask/event.h"
#include "macrotask/lock.h"
#include "macrotask/task.h"
#include "macrotask/task_list.h"
#include "macrotask/trace.h"
#include "tests/macrotask/process.h"
#include "tests/macrotask/support.h"

namespace macrotask {
namespace {

std::size_t Index(int i) { return static_cast<std::size_t>(i); }

bool AllTasksWait() {
  for (const TaskStatus& task : ListTasks()) {
    if (task.state == TaskState::kReady || task.state == TaskState::kRunning) {
      return false;
    }
  }
  return true;
}

using NoDeadlockTest = ByPolicy;

TEST_P(NoDeadlockTest, WhileATaskSleepsInASystemCall) {
  Event posted(GetParam());
  RunTasks(
      4,
      [&](int task) {
        if (task != 2) return posted.Wait();
        poll(nullptr, 0, 20);
        posted.Post();
      },
      GetParam());
}

TEST_P(NoDeadlockTest, WhileATaskReadsWhatAnUnknownPthreadWrites) {
  int ends[2];
  ASSERT_EQ(pipe(ends), 0);
  Event posted(GetParam());
  std::thread unknown([&] {
    poll(nullptr, 0, 20);
    EXPECT_EQ(write(ends[1], "x", 1), 1);
  });
  RunTasks(
      4,
      [&](int task) {
        if (task != 2) return posted.Wait();
        char read_byte = 0;
        EXPECT_EQ(read(ends[0], &read_byte, 1), 1);
        posted.Post();
      },
      GetParam());
  unknown.join();
  close(ends[0]);
  close(ends[1]);
}

TEST_P(NoDeadlockTest, WhileAnUnknownPthreadMayYetPost) {
  Event posted(GetParam());
  std::thread unknown([&] {
    YieldUntil([] { return AllTasksWait(); });
    // They look for a deadlock about now.
    for (int i = 0; i < 1000; ++i) sched_yield();
    posted.Post();
  });
  RunTasks(
      4, [&](int) { posted.Wait(); }, GetParam());
  unknown.join();
}

TEST_P(NoDeadlockTest, WhileATaskIsBeingStarted) {
  constexpr int kNumStarts = kSanitized ? 1000 : 5000;
  Event over(GetParam());
  int num_runs = 0;
  RunTasks(
      3,
      [&](int task) {
        if (task != 0) return over.Wait();
        for (int i = 0; i < kNumStarts; ++i) {
          Task([&] { ++num_runs; }, {.wait = GetParam()}).Wait();
        }
        over.Post();
      },
      GetParam());
  EXPECT_EQ(num_runs, kNumStarts);
}

// The started one is the only one to go on, and starts the next.
void StartNested(int depth, const WaitPolicy& policy, int* num_runs) {
  ++*num_runs;
  if (depth == 0) return;
  Task([=] { StartNested(depth - 1, policy, num_runs); }, {.wait = policy})
      .Wait();
}

TEST_P(NoDeadlockTest, WhileStarterUponStarterWaits) {
  int num_runs = 0;
  for (int round = 0; round < 50; ++round) {
    StartNested(12, GetParam(), &num_runs);
  }
  EXPECT_EQ(num_runs, 50 * 13);
}

// Pthreads of the program's own become tasks by waiting, post and end.
TEST_P(NoDeadlockTest, WhileForeignPthreadsComeAndGo) {
  for (int round = 0; round < 100; ++round) {
    Event ping(GetParam());
    Event pong(GetParam());
    std::thread foreign([&] {
      ping.Wait();
      pong.Post();
    });
    ping.Post();
    pong.Wait();
    foreign.join();
  }
}

INSTANTIATE_BY_POLICY(NoDeadlockTest);

// Hundreds of thousands of waits, most of which leave a single task to run.
using NoDeadlockStressTest = ByPolicyAndTasks;

const WaitPolicy kSleepyPolicies[] = {
    WaitPolicy::Block(), WaitPolicy::Spin(),
    WaitPolicy::Hold(std::chrono::nanoseconds(0))};

constexpr int kNumWaits = kSanitized ? 2000 : 40'000;

TEST_P(NoDeadlockStressTest, EventsInACircle) {
  std::deque<Event> turns;
  for (int i = 0; i < num_tasks(); ++i) turns.emplace_back(policy());
  std::int64_t num_turns = 0;
  turns[0].Post();
  RunTasks(
      num_tasks(),
      [&](int task) {
        for (int round = 0; round < kNumWaits / num_tasks(); ++round) {
          turns[Index(task)].Wait();
          turns[Index(task)].Clear();
          ++num_turns;
          turns[Index((task + 1) % num_tasks())].Post();
        }
      },
      policy());
  EXPECT_EQ(num_turns, kNumWaits / num_tasks() * num_tasks());
}

TEST_P(NoDeadlockStressTest, OneLockHandedRound) {
  Lock lock(policy());
  std::int64_t total = 0;
  RunTasks(
      num_tasks(),
      [&](int) {
        for (int round = 0; round < kNumWaits / num_tasks(); ++round) {
          lock.On();
          ++total;
          if (round % 16 == 0) sched_yield();  // so that others queue
          lock.Off();
        }
      },
      policy());
  EXPECT_EQ(total, kNumWaits / num_tasks() * num_tasks());
}

// The first one to queue makes the holder unlock in another way, and may find it
// in the middle of that.
TEST_P(NoDeadlockStressTest, ManyLocksOneAfterTheOther) {
  std::deque<Lock> locks;
  for (int i = 0; i < kNumWaits / 4 / num_tasks(); ++i) {
    locks.emplace_back(policy());
  }
  std::vector<int> totals(locks.size());
  RunTasks(
      num_tasks(),
      [&](int) {
        for (std::size_t i = 0; i < locks.size(); ++i) {
          locks[i].On();
          ++totals[i];
          if (i % 16 == 0) sched_yield();  // so that others queue
          locks[i].Off();
        }
      },
      policy());
  EXPECT_EQ(totals, std::vector<int>(locks.size(), num_tasks()));
}

TEST_P(NoDeadlockStressTest, BarriersAndTasks) {
  Barrier barrier(num_tasks(), policy());
  std::atomic<int> total = 0;
  RunTasks(
      num_tasks(),
      [&](int task) {
        for (int round = 0; round < kNumWaits / 4 / num_tasks(); ++round) {
          barrier.Sync();
          if (task == round % num_tasks()) {
            Task([&] { ++total; }, {.wait = policy()}).Wait();
          }
          barrier.Sync();
        }
      },
      policy());
  EXPECT_EQ(total, kNumWaits / 4 / num_tasks());
}

// Listing the tasks holds them in their waits for a moment.
TEST_P(NoDeadlockStressTest, BesideATaskThatListsTheTasks) {
  std::atomic<bool> over = false;
  Task lister([&] {
    while (!over) {
      const std::size_t num_listed = ListTasks().size();
      EXPECT_GE(num_listed, Index(num_tasks()));
    }
  });
  Barrier barrier(num_tasks(), policy());
  Lock lock(policy());
  std::int64_t total = 0;
  RunTasks(
      num_tasks(),
      [&](int) {
        for (int round = 0; round < kNumWaits / 20 / num_tasks(); ++round) {
          barrier.Sync();
          lock.On();
          ++total;
          lock.Off();
        }
      },
      policy());
  over = true;
  lister.Wait();
  EXPECT_EQ(total, kNumWaits / 20 / num_tasks() * num_tasks());
}

INSTANTIATE_TEST_SUITE_P(Policies, NoDeadlockStressTest,
                         testing::Combine(testing::ValuesIn(kSleepyPolicies),
                                          testing::ValuesIn(kTaskCounts)),
                         PolicyAndTasksName);

}  // namespace
}  // namespace macrotask
