#pragma once

#include "macrotask/task_registry.h"

namespace macrotask {

// Internal: a wait of the calling task that has turned out to be long, seen
// from outside as long as this object lives (Examine() of its TaskRecord).
class [[nodiscard]] PublishedWait {
 public:
  // `done()` says whether the wait is over: once true, it stays true. A wait
  // for kNone is not published: whoever waits is no task.
  template <typename Done>
  PublishedWait(const WaitedObject& what, const Done& done)
      : record_(what.kind == ObjectKind::kNone ? nullptr : &RecordOfCaller()) {
    if (record_ == nullptr) return;
    record_->BeginWait(
        what,
        [](const void* wait) { return (*static_cast<const Done*>(wait))(); },
        &done);
  }
  ~PublishedWait() {
    if (record_ != nullptr) record_->EndWait();
  }
  PublishedWait(const PublishedWait&) = delete;
  PublishedWait& operator=(const PublishedWait&) = delete;

  // The task looks for a deadlock; now and then while it spins.
  void Look() const;

  // The task gives its processor up; has it back.
  void BeginSleep() const;
  void EndSleep() const;

 private:
  TaskRecord* const record_;
};

}  // namespace macrotask
