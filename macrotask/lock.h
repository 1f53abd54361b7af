#pragma once

#include <atomic>
#include <cstdint>

#include "macrotask/cache_line.h"
#include "macrotask/mutex.h"
#include "macrotask/wait_policy.h"
#include "macrotask/waited_object.h"

namespace macrotask {

// A lock that tasks get in the order in which they asked. It has no owner: any
// task may unlock it.
//
// Cray name: LOCKON, LOCKOFF, LOCKTEST, on a lock assigned by LOCKASGN.
// Use: any task may call anything. A task that locks twice waits for another
// one to unlock, for ever if there is none. The lock must outlive the last
// return from any of its functions.
// Memory ordering: what a task wrote before Off() is visible to the task that
// holds the lock next, be it through On() or a Test() that returned false.
// Cost: uncontended, one atomic read-modify-write each for On(), Off() and
// Test(); with a queue, a hand-over to its head (bench rows "LOCKON" and
// "LOCKTEST").
//
//   Lock lock;
//   lock.On();
//   total += mine;
//   lock.Off();
class Lock {
 public:
  // Makes a clear lock on which tasks wait as `policy` says.
  explicit Lock(WaitPolicy policy = {}) : policy_(policy) {}
  Lock(const Lock&) = delete;
  Lock& operator=(const Lock&) = delete;

  // Returns when the caller holds the lock. First come, first served.
  void On();

  // Clears the lock, or hands it to the task that has waited longest. Harmless
  // on a clear lock.
  void Off();

  // Returns true if the lock was set already; otherwise sets it and returns
  // false: the caller now holds it. Never waits, but gives way to other tasks
  // when it returns true with more tasks than processors, because its callers
  // spin.
  [[nodiscard]] bool Test();

  // Number of tasks that wait in On() now.
  int num_waiting() const;

  // True iff some task holds the lock.
  bool is_set() const;

  // The number of the task that took the lock last if it is set; 0 if it is
  // clear, or if a pthread took it that is no task. Any task may unlock, so
  // that this is a hint to whom to ask.
  std::uint32_t holder() const;

  const WaitPolicy& policy() const { return policy_; }

  // Of this lock in lists and traces: 1, 2, ... in order of construction.
  std::uint32_t number() const { return number_; }

 private:
  struct Waiter;

  bool TryOn();
  void OnUntraced();
  bool Enqueue(Waiter& self);

  // 0 clear; else set: holder << 2 | somebody_is_queued << 1 | 1. On a line of
  // its own, because tasks spin on it.
  alignas(kCacheLine) std::atomic<std::uint64_t> state_{0};

  alignas(kCacheLine) mutable Mutex mutex_;  // guards the queue
  Waiter* head_ = nullptr;
  Waiter* tail_ = nullptr;
  int num_waiting_ = 0;
  const WaitPolicy policy_;
  const std::uint32_t number_ = NextNumber(ObjectKind::kLock);
};

}  // namespace macrotask
