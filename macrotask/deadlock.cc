#include "macrotask/deadlock.h"

#include <dirent.h>

#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "macrotask/program_end.h"
#include "macrotask/task_list.h"
#include "macrotask/task_registry.h"
#include "macrotask/task_status.h"

// Why there is no false alarm.
//
// A wait that is not over can only be ended by a task that runs. The search
// reads the words of all records twice. If the second pass finds every word as
// the first has read it, then at the moment between the two every task was in
// the wait in which both passes saw it; the second pass also finds that none of
// these waits was over, hence none was over at that moment (what is over stays
// over). So at that moment no task ran, and none could ever run again: a record
// changes only by its own pthread or by a task that starts another one.
//
// Why no deadlock is missed: a task publishes its wait, and a pthread its
// task's end, before it searches, all by sequentially consistent operations.
// The last of them to do so therefore sees all the others.

namespace macrotask {
namespace {

std::atomic<bool> detects{true};

bool CanRun(TaskState state) {
  return state == TaskState::kReady || state == TaskState::kRunning;
}

// The first pass, over all records from `first` on. Returns false if one of the
// tasks can run.
bool SeeAll(TaskRecord* first) {
  for (TaskRecord* record = first; record != nullptr; record = record->next()) {
    record->seen = record->Read();
    if (CanRun(record->seen.state)) return false;
  }
  return true;
}

bool SomeTaskCanRun() {
  for (const TaskRecord* record = TaskRegistry::TheOne().first();
       record != nullptr; record = record->next()) {
    if (CanRun(record->Read().state)) return true;
  }
  return false;
}

// Whether the process has a pthread of which this library knows nothing. Also
// true if the system does not say.
bool HasUnknownPthread() {
  std::set<std::string> known = {".", ".."};
  for (const TaskRecord* record = TaskRegistry::TheOne().first();
       record != nullptr; record = record->next()) {
    known.insert(std::to_string(record->pthread_id()));
  }
#ifdef __SANITIZE_THREAD__
  int num_unknown_allowed = 1;  // ThreadSanitizer's own.
#else
  int num_unknown_allowed = 0;
#endif
  const std::unique_ptr<DIR, int (*)(DIR*)> tasks(opendir("/proc/self/task"),
                                                  &closedir);
  if (tasks == nullptr) return true;
  while (const dirent* entry = readdir(tasks.get())) {
    if (known.contains(entry->d_name)) continue;
    if (--num_unknown_allowed < 0) return true;
  }
  return false;
}

// The second pass. Returns true if all tasks still are where the first one saw
// them, some wait and no wait is over. Lists them in `tasks` unless that is null.
bool ConfirmAll(TaskRecord* first, std::vector<TaskStatus>* tasks) {
  bool some_wait = false;
  for (TaskRecord* record = first; record != nullptr; record = record->next()) {
    const TaskRecord::Word word = record->seen;
    TaskStatus status = StatusOf(*record, word);
    bool all_over = false;
    const bool waits =
        record->Examine(word, [&](const WaitedObject& what, bool is_over) {
          all_over = is_over;
          NoteWait(what, &status);
        });
    some_wait |= waits;
    if (all_over || (!waits && !(record->Read() == word))) return false;
    if (tasks != nullptr && word.state != TaskState::kNone) {
      tasks->push_back(status);
    }
  }
  return some_wait && TaskRegistry::TheOne().first() == first;
}

}  // namespace

void SetDeadlockDetection(bool on) {
  detects.store(on, std::memory_order_relaxed);
}

void DetectDeadlock() {
  if (!detects.load(std::memory_order_relaxed)) return;
  if (SomeTaskCanRun()) return;

  std::vector<TaskStatus> tasks;
  {
    const MutexGuard one_at_a_time(ExamineMutex());
    TaskRecord* const first = TaskRegistry::TheOne().first();
    // Once without any allocation; most searches that get so far end here, as
    // a task has been released and has not left its wait yet.
    if (!SeeAll(first) || !ConfirmAll(first, nullptr)) return;
    if (!SeeAll(first) || HasUnknownPthread() || !ConfirmAll(first, &tasks)) {
      return;
    }
  }
  SortByNumber(&tasks);
  const std::string cycle = FindCycle(tasks);
  std::string text = ToString(tasks);
  if (!cycle.empty()) text += "Cycle: " + cycle + "\n";
  text += "Deadlock - All user tasks waiting for locks, events, or tasks\n";
  StopProgram(text, kDeadlockExitCode);
}

}  // namespace macrotask
