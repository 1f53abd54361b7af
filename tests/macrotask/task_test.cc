#include "macrotask/task.h"

#include <gtest/gtest.h>
#include <pthread.h>
#include <sched.h>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

#include "macrotask/barrier.h"
#include "macrotask/event.h"
#include "tests/macrotask/support.h"

namespace macrotask {
namespace {

std::size_t Index(int i) { return static_cast<std::size_t>(i); }

std::ptrdiff_t CountThreads() {
  using Iterator = std::filesystem::directory_iterator;
  return std::distance(Iterator("/proc/self/task"), Iterator());
}

using TaskTest = ByPolicy;

TEST_P(TaskTest, WaitReturnsAfterTheBodyAndTwiceIsFine) {
  int result = 0;
  Task task([&] { result = 42; }, {.wait = GetParam()});
  task.Wait();
  EXPECT_EQ(result, 42);
  task.Wait();
  EXPECT_FALSE(task.Test());
}

TEST_P(TaskTest, TestIsTrueUntilTheBodyEnds) {
  Event may_end(GetParam());
  Task task([&] { may_end.Wait(); }, {.wait = GetParam()});
  EXPECT_TRUE(task.Test());
  may_end.Post();
  task.Wait();
  EXPECT_FALSE(task.Test());
}

TEST_P(TaskTest, DestructorWaits) {
  for (int round = 0; round < 200; ++round) {
    int result = 0;
    {
      Task task([&] { result = round + 1; }, {.wait = GetParam()});
    }
    EXPECT_EQ(result, round + 1);
  }
}

TEST_P(TaskTest, SeveralTasksMayWaitForOne) {
  Event may_end(GetParam());
  int result = 0;
  std::atomic<int> sum = 0;
  Task awaited(
      [&] {
        may_end.Wait();
        result = 3;
      },
      {.wait = GetParam()});
  RunTasks(
      7,
      [&](int task) {
        if (task == 0) may_end.Post();
        awaited.Wait();
        sum += result;
      },
      GetParam());
  EXPECT_EQ(sum, 21);
}

TEST_P(TaskTest, WhatTheBodyThrowsReachesEveryWaiterEveryTime) {
  Task failing([] { throw std::runtime_error("no convergence"); },
               {.wait = GetParam()});
  std::atomic<int> num_caught = 0;
  RunTasks(
      4,
      [&](int) {
        for (int i = 0; i < 2; ++i) {
          try {
            failing.Wait();
          } catch (const std::runtime_error& error) {
            num_caught += std::string(error.what()) == "no convergence";
          }
        }
      },
      GetParam());
  EXPECT_EQ(num_caught, 8);
  EXPECT_FALSE(failing.Test());
}

TEST_P(TaskTest, TasksMayStartTasks) {
  std::atomic<int> sum = 0;
  RunTasks(
      3,
      [&](int task) {
        Task inner([&, task] { sum += task; }, {.wait = GetParam()});
        inner.Wait();
        sum += 10;
      },
      GetParam());
  EXPECT_EQ(sum, 33);
}

INSTANTIATE_BY_POLICY(TaskTest);

TEST(TaskValueTest, IsTheUserValueInTheTaskAndZeroElsewhere) {
  EXPECT_EQ(Task::Value(), 0u);
  std::uint64_t inside = 0;
  Task named([&] { inside = Task::Value(); }, {.value = 0x434841494e203120});
  named.Wait();
  EXPECT_EQ(inside, 0x434841494e203120u);
  EXPECT_EQ(Task::Value(), 0u);
  // Most likely on the same pthread.
  Task unnamed([&] { inside = Task::Value(); });
  unnamed.Wait();
  EXPECT_EQ(inside, 0u);
}

TEST(TaskNumberTest, GrowsByOneFromTheInitialTasksOne) {
  Task one([] {});
  Task other([] {});
  EXPECT_GT(one.number(), 1u);
  EXPECT_EQ(other.number(), one.number() + 1);
}

TEST(TaskNumberTest, IsTheSameAfterTheTaskHasEnded) {
  Task task([] {});
  const std::uint32_t number = task.number();
  task.Wait();
  EXPECT_EQ(task.number(), number);
}

TEST(TaskConstructorTest, RefusesAForeignProcessorAndAnEmptyBody) {
  EXPECT_THROW(Task([] {}, {.processor = 1 << 20}), std::invalid_argument);
  EXPECT_THROW(Task([] {}, {.processor = -2}), std::invalid_argument);
  EXPECT_THROW(Task(nullptr), std::invalid_argument);
}

TEST(TaskConstructorTest, PutsTheTaskOnItsProcessor) {
  for (int round = 0; round < 20; ++round) {
    const int processor = Placement(1).processor(0);
    int seen = -1;
    int num_allowed = 0;
    Task pinned([&] { seen = sched_getcpu(); }, {.processor = processor});
    pinned.Wait();
    EXPECT_EQ(seen, processor);
    Task free([&] {
      cpu_set_t mask;
      pthread_getaffinity_np(pthread_self(), sizeof mask, &mask);
      num_allowed = CPU_COUNT(&mask);
    });
    free.Wait();
    EXPECT_EQ(num_allowed, NumProcessors());
  }
}

using RunTasksTest = ByPolicyAndTasks;

TEST_P(RunTasksTest, RunsEveryTaskOnceAndTheFirstInTheCaller) {
  std::vector<int> num_runs(Index(num_tasks()), 0);
  const pthread_t caller = pthread_self();
  bool first_in_caller = false;
  for (int round = 0; round < 100; ++round) {
    RunTasks(
        num_tasks(),
        [&](int task) {
          ++num_runs[Index(task)];
          if (task == 0)
            first_in_caller = pthread_equal(caller, pthread_self());
        },
        policy());
  }
  EXPECT_EQ(num_runs, std::vector<int>(Index(num_tasks()), 100));
  EXPECT_TRUE(first_in_caller);
}

TEST_P(RunTasksTest, SecondRunCreatesNoThread) {
  const auto run = [&] {
    Barrier barrier(num_tasks(), policy());
    RunTasks(
        num_tasks(), [&](int) { barrier.Sync(); }, policy());
  };
  run();
  const std::ptrdiff_t before = CountThreads();
  for (int round = 0; round < num_rounds(); ++round) run();
  EXPECT_EQ(CountThreads(), before);
}

TEST_P(RunTasksTest, ThrowsWhatTheLowestNumberedTaskThrew) {
  std::atomic<int> num_ended = 0;
  const int first = num_tasks() / 2;
  try {
    RunTasks(
        num_tasks(),
        [&](int task) {
          ++num_ended;
          if (task >= first) throw std::runtime_error(std::to_string(task));
        },
        policy());
    FAIL() << "nothing was thrown";
  } catch (const std::runtime_error& error) {
    EXPECT_EQ(error.what(), std::to_string(first));
  }
  EXPECT_EQ(num_ended, num_tasks());
}

TEST_P(RunTasksTest, TasksAreWherePlacementSays) {
  const Placement placement(num_tasks());
  std::vector<int> seen(Index(num_tasks()), kAnyProcessor);
  RunTasks(
      num_tasks(), [&](int task) { seen[Index(task)] = sched_getcpu(); },
      policy());
  for (int task = 0; task < num_tasks(); ++task) {
    EXPECT_EQ(seen[Index(task)], placement.processor(task)) << task;
  }
}

TEST_P(RunTasksTest, GivesTheCallerItsAffinityBack) {
  cpu_set_t before;
  cpu_set_t after;
  pthread_getaffinity_np(pthread_self(), sizeof before, &before);
  RunTasks(
      num_tasks(), [](int) {}, policy());
  EXPECT_THROW(RunTasks(
                   num_tasks(), [](int) { throw 1; }, policy()),
               int);
  pthread_getaffinity_np(pthread_self(), sizeof after, &after);
  EXPECT_TRUE(CPU_EQUAL(&before, &after));
}

INSTANTIATE_BY_POLICY_AND_TASKS(RunTasksTest);

using NestedRunTasksTest = ByPolicy;

TEST_P(NestedRunTasksTest, EachRunHasItsOwnBarriers) {
  Barrier outer(3, GetParam());
  std::atomic<int> num_errors = 0;
  RunTasks(
      3,
      [&](int) {
        for (int round = 0; round < 5; ++round) {
          Barrier inner(4, GetParam());
          num_errors += CountPhaseErrors(
              4, 10, [&](int) { inner.Sync(); }, GetParam());
          outer.Sync();
        }
      },
      GetParam());
  EXPECT_EQ(num_errors, 0);
}

INSTANTIATE_BY_POLICY(NestedRunTasksTest);

TEST(RunTasksArgumentsTest, RefusesLessThanOneTaskAndAnEmptyBody) {
  EXPECT_THROW(RunTasks(0, [](int) {}), std::invalid_argument);
  EXPECT_THROW(RunTasks(1, nullptr), std::invalid_argument);
}

}  // namespace
}  // namespace macrotask
