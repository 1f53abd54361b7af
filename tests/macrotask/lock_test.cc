#include "macrotask/lock.h"

#include <gtest/gtest.h>

#include <atomic>
#include <deque>
#include <vector>

#include "macrotask/asymmetric_fence.h"
#include "macrotask/barrier.h"
#include "macrotask/event.h"
#include "macrotask/task.h"
#include "tests/macrotask/support.h"

namespace macrotask {
namespace {

using LockTest = ByPolicyAndTasks;

TEST_P(LockTest, OneTaskAtATimeHoldsIt) {
  Lock lock(policy());
  int total = 0;
  RunTasks(
      num_tasks(),
      [&](int) {
        for (int round = 0; round < num_rounds(); ++round) {
          lock.On();
          ++total;
          lock.Off();
        }
      },
      policy());
  EXPECT_EQ(total, num_tasks() * num_rounds());
  EXPECT_EQ(lock.num_waiting(), 0);
  EXPECT_FALSE(lock.Test());
}

TEST_P(LockTest, TasksGetItInTheOrderInWhichTheyAsked) {
  for (int round = 0; round < 10; ++round) {
    Lock lock(policy());
    std::vector<int> order;
    std::vector<int> expected;
    std::deque<Task> tasks;
    lock.On();
    for (int task = 0; task < num_tasks(); ++task) {
      expected.push_back(task);
      tasks.emplace_back([&, task] {
        lock.On();
        order.push_back(task);
        lock.Off();
      });
      YieldUntil([&] { return lock.num_waiting() == task + 1; });
    }
    lock.Off();
    for (Task& task : tasks) task.Wait();
    EXPECT_EQ(order, expected);
  }
}

TEST_P(LockTest, TestThatReturnsFalseExcludesOthers) {
  Lock lock(policy());
  int total = 0;
  RunTasks(
      num_tasks(),
      [&](int task) {
        for (int round = 0; round < num_rounds(); ++round) {
          if (task % 2 == 0) {
            while (lock.Test()) {
            }
          } else {
            lock.On();
          }
          ++total;
          lock.Off();
        }
      },
      policy());
  EXPECT_EQ(total, num_tasks() * num_rounds());
}

// No task is promised to be alone then, but each must get the lock.
TEST_P(LockTest, NobodyIsLostWhenSeveralTasksUnlockAtOnce) {
  constexpr int kNumUnlockers = 2;
  for (int round = 0; round < num_rounds() / 10; ++round) {
    Lock lock(policy());
    std::atomic<int> num_through = 0;
    lock.On();
    RunTasks(
        kNumUnlockers + num_tasks(),
        [&](int task) {
          if (task < kNumUnlockers) return lock.Off();
          lock.On();
          ++num_through;
          lock.Off();
        },
        policy());
    EXPECT_EQ(num_through, num_tasks());
    EXPECT_EQ(lock.num_waiting(), 0);
  }
}

INSTANTIATE_BY_POLICY_AND_TASKS(LockTest);

using LockOwnerTest = ByPolicy;

TEST_P(LockOwnerTest, TestSaysWhetherItWasSet) {
  Lock lock(GetParam());
  EXPECT_FALSE(lock.Test());
  EXPECT_TRUE(lock.Test());
  lock.Off();
  EXPECT_FALSE(lock.Test());
}

TEST_P(LockOwnerTest, OffOnAClearLockIsHarmless) {
  Lock lock(GetParam());
  lock.Off();
  EXPECT_FALSE(lock.Test());
  EXPECT_TRUE(lock.Test());
}

TEST_P(LockOwnerTest, AnyTaskMayUnlock) {
  Lock lock(GetParam());
  int data = 1;
  lock.On();
  Task task([&] {
    data = 2;
    lock.Off();
  });
  lock.On();
  EXPECT_EQ(data, 2);
}

// A lock as a signal: each task unlocks what the other one waits for.
TEST_P(LockOwnerTest, TwoLocksPassTheTurnBetweenTwoTasks) {
  Lock turns[2] = {Lock(GetParam()), Lock(GetParam())};
  std::vector<int> order;
  turns[0].On();
  turns[1].On();
  turns[0].Off();
  RunTasks(
      2,
      [&](int task) {
        for (int round = 0; round < 500; ++round) {
          turns[task].On();
          order.push_back(task);
          turns[1 - task].Off();
        }
      },
      GetParam());
  ASSERT_EQ(order.size(), 1000u);
  for (std::size_t i = 0; i < order.size(); ++i) {
    ASSERT_EQ(order[i], static_cast<int>(i % 2)) << "turn " << i;
  }
}

TEST_P(LockOwnerTest, KnowsWhetherItIsSetAndWhoTookItLast) {
  Lock lock(GetParam());
  EXPECT_FALSE(lock.is_set());
  EXPECT_EQ(lock.holder(), 0u);
  lock.On();
  EXPECT_TRUE(lock.is_set());
  EXPECT_EQ(lock.holder(), 1u);
  lock.Off();
  EXPECT_FALSE(lock.is_set());
  EXPECT_EQ(lock.holder(), 0u);
  EXPECT_FALSE(lock.Test());
  EXPECT_TRUE(lock.is_set());
  EXPECT_EQ(lock.holder(), 1u);
  Task task([&] { lock.Off(); });
  task.Wait();
  EXPECT_FALSE(lock.is_set());
  EXPECT_EQ(lock.holder(), 0u);
}

TEST_P(LockOwnerTest, IsHeldByTheTaskThatItIsHandedTo) {
  Lock lock(GetParam());
  Event looked(GetParam());
  lock.On();
  Task next([&] {
    lock.On();
    looked.Wait();
    lock.Off();
  });
  YieldUntil([&] { return lock.num_waiting() == 1; });
  EXPECT_EQ(lock.holder(), 1u);
  lock.Off();
  // Handed over, not clear in between.
  EXPECT_TRUE(lock.is_set());
  EXPECT_EQ(lock.holder(), next.number());
  looked.Post();
  next.Wait();
  EXPECT_FALSE(lock.is_set());
}

// The first one to queue at a lock may find its holder in the middle of
// unlocking by a store, which is not allowed from then on.
TEST_P(LockOwnerTest, NobodyIsLostWhoQueuesWhileTheHolderUnlocks) {
  constexpr int kNumLocks = 20'000;
  std::deque<Lock> locks;
  for (int i = 0; i < kNumLocks; ++i) locks.emplace_back(GetParam());
  Barrier barrier(2, GetParam());
  RunTasks(
      2,
      [&](int task) {
        int num_locks = 0;
        for (Lock& lock : locks) {
          if (task == 0) lock.On();
          barrier.Sync();
          if (task == 1) lock.On();
          // Now and then just as long as the other task takes to queue.
          for (int i = ++num_locks % 256; i > 0; --i) asm volatile("");
          lock.Off();
        }
      },
      GetParam());
}

// However Off() clears the lock by then.
TEST_P(LockOwnerTest, IsHandedOverAfterAnyNumberOfTurnsWithoutAQueue) {
  for (const int surplus : {-kLightFencesPerHeavyOne, -1, 0, 1, 2, 100}) {
    Lock lock(GetParam());
    for (int queue = 0; queue < 3; ++queue) {
      for (int turn = 0; turn < kLightFencesPerHeavyOne + surplus; ++turn) {
        lock.On();
        lock.Off();
      }
      lock.On();
      Task next([&] {
        lock.On();
        lock.Off();
      });
      YieldUntil([&] { return lock.num_waiting() == 1; });
      lock.Off();
      next.Wait();
      EXPECT_FALSE(lock.is_set());
    }
  }
}

TEST(LockNumberTest, GrowsByOneWithEveryLock) {
  const Lock one;
  const Lock other;
  EXPECT_GE(one.number(), 1u);
  EXPECT_EQ(other.number(), one.number() + 1);
}

INSTANTIATE_BY_POLICY(LockOwnerTest);

}  // namespace
}  // namespace macrotask
