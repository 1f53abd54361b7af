#pragma once

// In place of macrotask/task_registry.h: the records are those of the program
// under check.

#include <unistd.h>

#include <cstdint>

#include "macrotask/task_record.h"

namespace macrotask {

class TaskRegistry {
 public:
  static TaskRegistry& TheOne() {
    static TaskRegistry registry;
    return registry;
  }
  TaskRecord* first() const { return first_; }

  void Clear() { first_ = nullptr; }
  void Add(TaskRecord* record) {
    record->next_ = first_;
    first_ = record;
  }

  // All tasks are fibers of the one pthread.
  static void Adopt(TaskRecord* record) {
    record->pthread_id_.store(gettid(), std::memory_order_release);
  }

 private:
  TaskRecord* first_ = nullptr;
};

// A task's number is that of its fiber, from 1.
struct NumberOfCaller {
  operator std::uint32_t() const { return rl::thread_index() + 1; }
  void operator=(std::uint32_t) const {}
};
inline constexpr NumberOfCaller number_of_caller;

struct CallerRecord {
  std::uint32_t number() const { return number_of_caller; }
};
inline CallerRecord RecordOfCaller() { return {}; }

}  // namespace macrotask
