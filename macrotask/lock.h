#pragma once

#include <atomic>
#include <cstdint>

#include "macrotask/cache_line.h"
#include "macrotask/mutex.h"
#include "macrotask/wait_policy.h"

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
  // false: the caller now holds it. Never waits, but gives up the processor
  // when it returns true with more tasks than processors, because its callers
  // spin.
  [[nodiscard]] bool Test();

  // Number of tasks that wait in On() now.
  int num_waiting() const;

 private:
  struct Waiter;

  bool TryOn();
  bool Enqueue(Waiter& self);

  // 0 clear, 1 set, 2 set and somebody is queued. On a line of its own, because
  // tasks spin on it.
  alignas(kCacheLine) std::atomic<std::uint32_t> state_{0};

  alignas(kCacheLine) mutable Mutex mutex_;  // guards the queue
  Waiter* head_ = nullptr;
  Waiter* tail_ = nullptr;
  int num_waiting_ = 0;
  const WaitPolicy policy_;
};

}  // namespace macrotask
