#include "macrotask/task_list.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

#include "macrotask/barrier.h"
#include "macrotask/event.h"
#include "macrotask/lock.h"
#include "macrotask/task.h"
#include "tests/macrotask/support.h"

namespace macrotask {
namespace {

TaskStatus Running(std::uint32_t number) {
  return {number, 0, TaskState::kRunning};
}

TaskStatus WaitsForTask(std::uint32_t number, std::uint32_t other) {
  return {number, 0, TaskState::kWaiting, ObjectKind::kTask, other};
}

TaskStatus WaitsForLock(std::uint32_t number, std::uint32_t lock,
                        std::uint32_t holder) {
  return {number, 0, TaskState::kWaiting, ObjectKind::kLock, lock, holder};
}

TaskStatus WaitsForEvent(std::uint32_t number, std::uint32_t event) {
  return {number, 0, TaskState::kWaiting, ObjectKind::kEvent, event};
}

constexpr const char* kHeading =
    "  task  user value                     state\n";

TEST(TaskListTextTest, HasALineForEachTaskAndTheTotal) {
  EXPECT_EQ(ToString({Running(1),
                      {2, 0x4847464544434241, TaskState::kWaiting,
                       ObjectKind::kLock, 7, 13},
                      {13, 5, TaskState::kReady},
                      {2'147'483'647, 0, TaskState::kComplete}}),
            std::string(kHeading) +
                "     1  0                              running\n"
                "     2  4847464544434241 'ABCDEFGH'    waiting for lock 7, "
                "held by task 13\n"
                "    13  5                              ready\n"
                "2147483647  0                              complete\n"
                "4 tasks, 1 waiting\n");
}

TEST(TaskListTextTest, SaysOneTaskInTheSingular) {
  EXPECT_EQ(ToString({Running(1)}),
            std::string(kHeading) +
                "     1  0                              running\n"
                "1 task, 0 waiting\n");
}

TEST(TaskListTextTest, NamesTheObjectOfEveryWait) {
  const auto state = [](ObjectKind kind) {
    const std::string text = ToString({{1, 0, TaskState::kWaiting, kind, 4}});
    const std::size_t begin = text.find("waiting");
    return text.substr(begin, text.find('\n', begin) - begin);
  };
  EXPECT_EQ(state(ObjectKind::kBarrier), "waiting for barrier 4");
  EXPECT_EQ(state(ObjectKind::kEvent), "waiting for event 4");
  EXPECT_EQ(state(ObjectKind::kLock), "waiting for lock 4");
  EXPECT_EQ(state(ObjectKind::kTask), "waiting for task 4");
}

// The value column.
std::string ValueText(std::uint64_t value) {
  std::string text = ToString({{1, value, TaskState::kRunning}});
  text = text.substr(std::string(kHeading).size() + 8, 29);
  return text.substr(0, text.find_last_not_of(' ') + 1);
}

TEST(TaskListTextTest, ShowsAValueAsTextIfAllOfItCanBePrinted) {
  EXPECT_EQ(ValueText(0), "0");
  EXPECT_EQ(ValueText(0x41), "41 'A'");
  EXPECT_EQ(ValueText(0x20204d5241), "20204d5241 'ARM  '");
  EXPECT_EQ(ValueText(0x0141), "141");
  EXPECT_EQ(ValueText(0x410041), "410041");
  EXPECT_EQ(ValueText(0xffffffffffffffff), "ffffffffffffffff");
}

TEST(FindCycleTest, IsEmptyWithoutACircle) {
  EXPECT_EQ(FindCycle({}), "");
  EXPECT_EQ(FindCycle({Running(1)}), "");
  EXPECT_EQ(FindCycle({WaitsForTask(1, 2), WaitsForTask(2, 3), Running(3)}),
            "");
  // Whom an event waits for is unknown; 9 is in no list; 0 is no task.
  EXPECT_EQ(FindCycle({WaitsForTask(1, 2), WaitsForEvent(2, 1)}), "");
  EXPECT_EQ(FindCycle({WaitsForTask(1, 9)}), "");
  EXPECT_EQ(FindCycle({WaitsForLock(1, 1, 0)}), "");
}

TEST(FindCycleTest, SeesATaskThatWaitsForItself) {
  EXPECT_EQ(FindCycle({WaitsForTask(4, 4)}), "task 4 waits for task 4");
  EXPECT_EQ(FindCycle({Running(1), WaitsForLock(2, 5, 2)}),
            "task 2 waits for lock 5, held by task 2");
}

TEST(FindCycleTest, FollowsTasksAndLocksRound) {
  EXPECT_EQ(FindCycle({WaitsForTask(1, 3), WaitsForLock(3, 2, 8),
                       WaitsForLock(8, 9, 1)}),
            "task 1 waits for task 3, which waits for lock 2, held by task 8, "
            "which waits for lock 9, held by task 1");
}

TEST(FindCycleTest, LeavesOutTheTailThatLeadsIntoTheCircle) {
  EXPECT_EQ(FindCycle({WaitsForTask(1, 2), WaitsForTask(2, 3),
                       WaitsForTask(3, 4), WaitsForTask(4, 3)}),
            "task 3 waits for task 4, which waits for task 3");
}

TEST(FindCycleTest, SeesTheFirstOfTwoCircles) {
  EXPECT_EQ(FindCycle({WaitsForEvent(1, 1), WaitsForTask(2, 3),
                       WaitsForTask(3, 2), WaitsForTask(4, 4)}),
            "task 2 waits for task 3, which waits for task 2");
}

// The row of a task, number 0 if there is none.
TaskStatus StatusOf(std::uint32_t number) {
  for (const TaskStatus& task : ListTasks()) {
    if (task.number == number) return task;
  }
  return {0, 0, TaskState::kNone};
}

using ListTasksTest = ByPolicy;

// Runs a task that waits in `wait()`, looks at its row, then ends the wait.
void ExpectWait(const std::function<void()>& wait,
                const std::function<void()>& end, ObjectKind kind,
                std::uint32_t object, std::uint32_t holder = 0) {
  Task task(wait, {.value = 77});
  const std::uint32_t number = task.number();
  YieldUntil([&] { return StatusOf(number).state == TaskState::kWaiting; });
  const TaskStatus status = StatusOf(number);
  EXPECT_EQ(status.number, number);
  EXPECT_EQ(status.value, 77u);
  EXPECT_EQ(status.waits_for, kind);
  EXPECT_EQ(status.object, object);
  EXPECT_EQ(status.holder, holder);
  end();
  task.Wait();
  YieldUntil([&] { return StatusOf(number).state == TaskState::kComplete; });
  EXPECT_EQ(StatusOf(number).waits_for, ObjectKind::kNone);
}

TEST_P(ListTasksTest, SaysWhatATaskWaitsFor) {
  Event event(GetParam());
  ExpectWait([&] { event.Wait(); }, [&] { event.Post(); }, ObjectKind::kEvent,
             event.number());
  Barrier barrier(2, GetParam());
  ExpectWait([&] { barrier.Sync(); }, [&] { barrier.Sync(); },
             ObjectKind::kBarrier, barrier.number());
  Event may_end(GetParam());
  Task awaited([&] { may_end.Wait(); }, {.wait = GetParam()});
  ExpectWait([&] { awaited.Wait(); }, [&] { may_end.Post(); },
             ObjectKind::kTask, awaited.number());
}

TEST_P(ListTasksTest, SaysWhoHoldsTheLockThatATaskWaitsFor) {
  Lock lock(GetParam());
  lock.On();
  ExpectWait([&] { lock.On(); }, [&] { lock.Off(); }, ObjectKind::kLock,
             lock.number(), 1);
}

TEST_P(ListTasksTest, KnowsWhoRuns) {
  Event may_end(GetParam());
  std::atomic<bool> runs = false;
  Task task([&] {
    runs = true;
    YieldUntil([&] { return may_end.Test(); });
  });
  YieldUntil([&] { return runs.load(); });
  EXPECT_EQ(StatusOf(task.number()).state, TaskState::kRunning);
  EXPECT_EQ(StatusOf(1).state, TaskState::kRunning);
  may_end.Post();
}

TEST_P(ListTasksTest, IsOrderedByNumber) {
  RunTasks(
      16, [](int) {}, GetParam());
  const auto tasks = ListTasks();
  EXPECT_GE(tasks.size(), 16u);
  EXPECT_TRUE(std::is_sorted(tasks.begin(), tasks.end(),
                             [](const TaskStatus& a, const TaskStatus& b) {
                               return a.number < b.number;
                             }));
}

INSTANTIATE_BY_POLICY(ListTasksTest);

// The pthread on its way to the task is another one's business: the record is
// put into that state as a starter does it.
TEST(ListTasksTest, KnowsWhoIsReady) {
  TaskRecord* const record = TaskRegistry::TheOne().Acquire();
  record->SetReady(2'000'000'000, 99);
  const TaskStatus status = StatusOf(2'000'000'000);
  EXPECT_EQ(status.state, TaskState::kReady);
  EXPECT_EQ(status.value, 99u);
}

}  // namespace
}  // namespace macrotask
