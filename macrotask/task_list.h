#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "macrotask/task_record.h"

namespace macrotask {

// One row of the list of tasks.
struct TaskStatus {
  std::uint32_t number;
  std::uint64_t value;  // the user value
  TaskState state;
  ObjectKind waits_for = ObjectKind::kNone;  // unless kWaiting: kNone
  std::uint32_t object = 0;                  // its number
  std::uint32_t holder = 0;  // of the lock it waits for: the task that took it
};

// All tasks of the process that have not ended, and those that have as long as
// their pthread has found no other, by number. A task that has waited for less
// than about a microsecond counts as running.
//
// Cray name: TSKLIST.
// Use: any task, at any time. What runs meanwhile may be seen a little earlier
// or later than the rest.
std::vector<TaskStatus> ListTasks();

// The table that TSKLIST prints, a line a task:
//
//   task  user value                     state
//      1  0                              waiting for task 3
//      3  4847464544434241 'ABCDEFGH'    waiting for lock 2, held by task 1
//   2 tasks, 2 waiting
std::string ToString(const std::vector<TaskStatus>& tasks);

// The tasks that wait for each other in a circle, as one sentence, or "" if
// there is no circle. An event and a barrier do not say who is missing.
//
//   task 1 waits for task 3, which waits for lock 2, held by task 1
std::string FindCycle(const std::vector<TaskStatus>& tasks);

}  // namespace macrotask
