#include "macrotask/task_list.h"

#include <algorithm>
#include <cctype>
#include <cinttypes>
#include <cstdio>
#include <map>

#include "macrotask/lock.h"
#include "macrotask/task_registry.h"
#include "macrotask/task_status.h"

namespace macrotask {
namespace {

// The eight characters of a value, as a Fortran program gives them (the first
// in the lowest byte); "" if they cannot be printed.
std::string AsText(std::uint64_t value) {
  std::string text;
  for (; value != 0; value >>= 8) text += static_cast<char>(value & 0xff);
  const bool printable =
      std::all_of(text.begin(), text.end(),
                  [](unsigned char c) { return std::isprint(c) != 0; });
  return printable ? text : "";
}

std::string ValueColumn(std::uint64_t value) {
  char hex[20];
  std::snprintf(hex, sizeof hex, "%" PRIx64, value);
  const std::string text = AsText(value);
  return text.empty() ? hex : std::string(hex) + " '" + text + "'";
}

std::string ObjectOf(const TaskStatus& task) {
  if (task.waits_for == ObjectKind::kNone) return "something";
  std::string text =
      std::string(Name(task.waits_for)) + " " + std::to_string(task.object);
  if (task.holder != 0) {
    text += ", held by task " + std::to_string(task.holder);
  }
  return text;
}

std::string StateColumn(const TaskStatus& task) {
  switch (task.state) {
    case TaskState::kReady:
      return "ready";
    case TaskState::kComplete:
      return "complete";
    case TaskState::kWaiting:
      return "waiting for " + ObjectOf(task);
    default:
      return "running";
  }
}

// The task without which `task` cannot go on, if that is known; else 0.
std::uint32_t BlockerOf(const TaskStatus& task) {
  if (task.state != TaskState::kWaiting) return 0;
  return task.waits_for == ObjectKind::kTask ? task.object : task.holder;
}

}  // namespace

Mutex& ExamineMutex() {
  static Mutex* const mutex = new Mutex;
  return *mutex;
}

TaskStatus StatusOf(const TaskRecord& record, const TaskRecord::Word& word) {
  return {record.number(), record.value(), word.state};
}

void NoteWait(const WaitedObject& what, TaskStatus* status) {
  status->waits_for = what.kind;
  status->object = what.number;
  if (what.lock != nullptr) status->holder = what.lock->holder();
}

void SortByNumber(std::vector<TaskStatus>* tasks) {
  std::sort(tasks->begin(), tasks->end(),
            [](const TaskStatus& a, const TaskStatus& b) {
              return a.number < b.number;
            });
}

std::vector<TaskStatus> ListTasks() {
  const MutexGuard guard(ExamineMutex());
  std::vector<TaskStatus> tasks;
  for (TaskRecord* record = TaskRegistry::TheOne().first(); record != nullptr;
       record = record->next()) {
    const TaskRecord::Word word = record->Read();
    if (word.state == TaskState::kNone) continue;
    TaskStatus status = StatusOf(*record, word);
    const bool waits =
        record->Examine(word, [&](const WaitedObject& what, bool is_over) {
          if (is_over) {
            status.state = TaskState::kRunning;
          } else {
            NoteWait(what, &status);
          }
        });
    if (word.state == TaskState::kWaiting && !waits) {
      status.state = TaskState::kRunning;
    }
    tasks.push_back(status);
  }
  SortByNumber(&tasks);
  return tasks;
}

std::string ToString(const std::vector<TaskStatus>& tasks) {
  std::string text = "  task  user value                     state\n";
  int num_waiting = 0;
  for (const TaskStatus& task : tasks) {
    char line[64];
    std::snprintf(line, sizeof line, "%6" PRIu32 "  %-29s  ", task.number,
                  ValueColumn(task.value).c_str());
    text += line + StateColumn(task) + "\n";
    if (task.state == TaskState::kWaiting) ++num_waiting;
  }
  return text + std::to_string(tasks.size()) +
         (tasks.size() == 1 ? " task, " : " tasks, ") +
         std::to_string(num_waiting) + " waiting\n";
}

std::string FindCycle(const std::vector<TaskStatus>& tasks) {
  std::map<std::uint32_t, const TaskStatus*> by_number;
  for (const TaskStatus& task : tasks) by_number[task.number] = &task;
  // Every task points to one other at most: who follows the arrows for as many
  // steps as there are tasks is in a circle, or has come to an end.
  for (const TaskStatus& start : tasks) {
    const TaskStatus* at = &start;
    std::string text = "task " + std::to_string(start.number);
    for (std::size_t step = 0; step < tasks.size(); ++step) {
      const auto next = by_number.find(BlockerOf(*at));
      if (next == by_number.end()) break;
      text +=
          (step == 0 ? " waits for " : ", which waits for ") + ObjectOf(*at);
      at = next->second;
      if (at == &start) return text;
    }
  }
  return "";
}

}  // namespace macrotask
