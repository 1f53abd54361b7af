// Programs that can go no further. Each has a process of its own, in which the
// initial task is 1 and the others are numbered in the order of their start.

#include "macrotask/deadlock.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <deque>
#include <string>
#include <thread>
#include <vector>

#include "macrotask/barrier.h"
#include "macrotask/event.h"
#include "macrotask/lock.h"
#include "macrotask/task.h"
#include "macrotask/task_list.h"
#include "tests/macrotask/process.h"
#include "tests/macrotask/support.h"

namespace macrotask {
namespace {

using DeadlockTest = InOwnProcess<ByPolicyAndTasks>;

std::size_t Index(int i) { return static_cast<std::size_t>(i); }

// Everything that the program says, given the state of each task.
std::string Report(const std::vector<std::string>& states,
                   const std::string& cycle = "") {
  std::string text = "  task  user value                     state\n";
  int number = 0, num_waiting = 0;
  for (const std::string& state : states) {
    char begin[64];
    std::snprintf(begin, sizeof begin, "%6d  0%-30s", ++number, "");
    text += begin + state + "\n";
    if (state.starts_with("waiting")) ++num_waiting;
  }
  text += std::to_string(number) + (number == 1 ? " task, " : " tasks, ") +
          std::to_string(num_waiting) + " waiting\n";
  if (!cycle.empty()) text += "Cycle: " + cycle + "\n";
  return text +
         "Deadlock - All user tasks waiting for locks, events, or tasks\n";
}

std::vector<std::string> All(int num_tasks, const std::string& state) {
  return std::vector<std::string>(Index(num_tasks), state);
}

std::string WaitsForTask(int task) {
  return "waiting for task " + std::to_string(task);
}

void ExpectDeadlock(const std::function<void()>& program,
                    const std::string& report) {
  EXPECT_EXIT(program(), testing::ExitedWithCode(3), Exactly(report));
}

int NumWaiting() {
  const auto tasks = ListTasks();
  return static_cast<int>(
      std::count_if(tasks.begin(), tasks.end(), [](const TaskStatus& task) {
        return task.state == TaskState::kWaiting;
      }));
}

TEST_P(DeadlockTest, AllWaitForAnEvent) {
  ExpectDeadlock(
      [&] {
        Event never(policy());
        RunTasks(
            num_tasks(), [&](int) { never.Wait(); }, OnPthreads(policy()));
      },
      Report(All(num_tasks(), "waiting for event 1")));
}

TEST_P(DeadlockTest, AllWaitAtABarrierForOneMore) {
  ExpectDeadlock(
      [&] {
        Barrier barrier(num_tasks() + 1, policy());
        RunTasks(
            num_tasks(), [&](int) { barrier.Sync(); }, OnPthreads(policy()));
      },
      Report(All(num_tasks(), "waiting for barrier 1")));
}

// The first or the last member, which a tree does not treat alike.
TEST_P(DeadlockTest, AMemberOfABarrierIsMissing) {
  for (BarrierAlgorithm algorithm : kAllBarrierAlgorithms) {
    for (int missing : {0, num_tasks()}) {
      ExpectDeadlock(
          [&] {
            Barrier barrier(num_tasks() + 1, policy(), algorithm);
            RunTasks(
                num_tasks(),
                [&](int task) { barrier.Sync(missing == 0 ? task + 1 : task); },
                policy());
          },
          Report(All(num_tasks(), "waiting for barrier 1")));
    }
  }
}

// The earlier phases must not count for the last.
TEST_P(DeadlockTest, OneTaskComesOnceTooOften) {
  if (num_tasks() == 1) return;  // holds nobody
  std::vector<std::string> states = All(num_tasks(), "complete");
  states[0] = "waiting for barrier 1";
  ExpectDeadlock(
      [&] {
        Barrier barrier(num_tasks(), policy());
        RunTasks(
            num_tasks(),
            [&](int task) {
              for (int phase = 0; phase < 100; ++phase) barrier.Sync();
              if (task == 0) barrier.Sync();
            },
            OnPthreads(policy()));
      },
      Report(states));
}

TEST_P(DeadlockTest, AllWaitForALockOfTheFirstWhoWaitsForItAsWell) {
  ExpectDeadlock(
      [&] {
        Lock lock(policy());
        lock.On();
        RunTasks(
            num_tasks(), [&](int) { lock.On(); }, OnPthreads(policy()));
      },
      Report(All(num_tasks(), "waiting for lock 1, held by task 1"),
             "task 1 waits for lock 1, held by task 1"));
}

// Every task holds a lock and waits for that of the next one.
TEST_P(DeadlockTest, LocksAreHeldInACircle) {
  std::vector<std::string> states;
  std::string cycle = "task 1 waits for ";
  for (int task = 1; task <= num_tasks(); ++task) {
    const std::string next = std::to_string(task % num_tasks() + 1);
    const std::string object = "lock " + next + ", held by task " + next;
    states.push_back("waiting for " + object);
    cycle += (task == 1 ? "" : ", which waits for ") + object;
  }
  ExpectDeadlock(
      [&] {
        std::deque<Lock> locks;
        for (int i = 0; i < num_tasks(); ++i) locks.emplace_back(policy());
        Barrier all_hold_one(num_tasks(), policy());
        RunTasks(
            num_tasks(),
            [&](int task) {
              locks[Index(task)].On();
              all_hold_one.Sync();
              locks[Index((task + 1) % num_tasks())].On();
            },
            OnPthreads(policy()));
      },
      Report(states, cycle));
}

// Starts `num_tasks` tasks of which each waits for the next one, and the last
// for `last`; then waits for the first. They have the numbers from 2.
template <typename Last>
void RunChain(int num_tasks, const WaitPolicy& policy, const Last& last) {
  std::deque<Task> tasks;
  Event all_started(policy);
  for (int i = 0; i < num_tasks; ++i) {
    tasks.emplace_back(
        [&, i] {
          all_started.Wait();
          if (i + 1 < num_tasks) {
            tasks[Index(i + 1)].Wait();
          } else {
            last(&tasks);
          }
        },
        TaskOptions{.wait = policy});
  }
  all_started.Post();
  tasks[0].Wait();
}

TEST_P(DeadlockTest, TasksWaitForEachOtherInACircle) {
  // The initial task waits for the circle without being in it.
  std::vector<std::string> states = {WaitsForTask(2)};
  std::string cycle = "task 2 waits for ";
  for (int task = 2; task <= num_tasks() + 1; ++task) {
    const int next = task == num_tasks() + 1 ? 2 : task + 1;
    states.push_back(WaitsForTask(next));
    cycle += (task == 2 ? "task " : ", which waits for task ") +
             std::to_string(next);
  }
  const auto wait_for_first = [](std::deque<Task>* tasks) {
    tasks->front().Wait();
  };
  ExpectDeadlock([&] { RunChain(num_tasks(), policy(), wait_for_first); },
                 Report(states, cycle));
}

TEST_P(DeadlockTest, AChainOfTasksEndsAtAnEvent) {
  std::vector<std::string> states;
  for (int task = 1; task <= num_tasks(); ++task) {
    states.push_back(WaitsForTask(task + 1));
  }
  states.push_back("waiting for event 2");
  const auto wait_for_ever = [&](std::deque<Task>*) {
    Event never(policy());
    never.Wait();
  };
  ExpectDeadlock([&] { RunChain(num_tasks(), policy(), wait_for_ever); },
                 Report(states));
}

// All others wait already: it is the end of a task that leaves none to run.
TEST_P(DeadlockTest, TheLastTaskThatCouldRunEnds) {
  std::vector<std::string> states = All(num_tasks(), "waiting for event 1");
  states.push_back("complete");
  ExpectDeadlock(
      [&] {
        Event never(policy());
        RunTasks(
            num_tasks() + 1,
            [&](int task) {
              if (task < num_tasks()) never.Wait();
              YieldUntil([&] { return NumWaiting() == num_tasks(); });
            },
            OnPthreads(policy()));
      },
      Report(states));
}

TEST_P(DeadlockTest, ForeignPthreadsWaitToo) {
  ExpectDeadlock(
      [&] {
        Event never(policy());
        std::deque<std::thread> threads;
        for (int i = 1; i < num_tasks(); ++i) {
          threads.emplace_back([&] { never.Wait(); });
        }
        never.Wait();
      },
      Report(All(num_tasks(), "waiting for event 1")));
}

// A pthread that has waited once is a task until it ends.
TEST_P(DeadlockTest, TheLastForeignPthreadThatCouldRunEnds) {
  std::vector<std::string> states = All(num_tasks(), "waiting for event 2");
  states.push_back("complete");
  const auto last = [&](Event* go_on) {
    go_on->Wait();
    YieldUntil([&] { return NumWaiting() == num_tasks(); });
  };
  ExpectDeadlock(
      [&] {
        Event go_on(policy());
        Event never(policy());
        Barrier all_started(num_tasks(), policy());
        std::thread* foreign = nullptr;
        RunTasks(
            num_tasks(),
            [&](int task) {
              all_started.Sync();
              if (task == 0) {
                foreign = new std::thread([&] { last(&go_on); });
                YieldUntil([&] { return NumWaiting() == num_tasks(); });
                go_on.Post();
              }
              never.Wait();
            },
            OnPthreads(policy()));
      },
      Report(states));
}

INSTANTIATE_BY_POLICY_AND_TASKS(DeadlockTest);

}  // namespace
}  // namespace macrotask
