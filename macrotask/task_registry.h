#pragma once

#include <atomic>
#include <cstdint>

#include "macrotask/task_record.h"

namespace macrotask {

// Internal: all records of this process. Never destroyed.
class TaskRegistry {
 public:
  static TaskRegistry& TheOne();

  // Returns a record for a new pthread that runs tasks, and takes it back.
  TaskRecord* Acquire();
  void Release(TaskRecord* record);

  // By the new pthread itself: the record is its own from now on.
  static void Adopt(TaskRecord* record);

  // The first record; the others hang on next().
  TaskRecord* first() const { return first_.load(std::memory_order_acquire); }

 private:
  std::atomic<TaskRecord*> first_{nullptr};
  TaskRecord* free_ = nullptr;  // guarded by a mutex in the source
};

// Internal: the record of the calling pthread, null if it has none yet, and the
// number of the task that it runs (0: none).
inline constinit thread_local TaskRecord* record_of_caller MACROTASK_TLS =
    nullptr;
inline constinit thread_local std::uint32_t number_of_caller MACROTASK_TLS = 0;

// Internal: the record of the calling pthread. One that this library has not
// made becomes a task by the first call of this.
TaskRecord& RegisterCaller();
inline TaskRecord& RecordOfCaller() {
  return record_of_caller != nullptr ? *record_of_caller : RegisterCaller();
}

// Internal: a number for a new task, which fits 31 bits. The initial task, the
// first to ask, has 1.
std::uint32_t NextTaskNumber();

}  // namespace macrotask
