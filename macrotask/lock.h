#pragma once

#include <atomic>
#include <cstdint>

#include "macrotask/asymmetric_fence.h"
#include "macrotask/cache_line.h"
#include "macrotask/load.h"
#include "macrotask/logical_wait.h"
#include "macrotask/mutex.h"
#include "macrotask/task_registry.h"
#include "macrotask/trace_point.h"
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
// Cost: uncontended, as the simplest lock that there is, one atomic
// read-modify-write for On() or for a Test() that returns false, and a store
// for Off(). With a queue, a hand-over to its head. The first one to queue pays
// a heavy fence (asymmetric_fence.h), and Off() is a read-modify-write as well
// until it has found no queue 4096 times (bench rows "LOCKON" and "LOCKTEST").
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

  // How Off() clears the lock. No enum class: the checkers print it.
  enum Clearing : std::uint32_t { kByExchange, kByStore };

  static constexpr std::uint64_t kClear = 0;
  static constexpr std::uint64_t kSet = 1;
  static constexpr std::uint64_t kQueued = 2;
  static constexpr std::uint64_t SetBy(std::uint32_t task) {
    return std::uint64_t{task} << 2 | kSet;
  }

  bool TryOn();
  void OnTraced();
  void AwaitTurn();
  void OffByExchange();
  void HandOver();
  void HelpQueue();
  bool Enqueue(Waiter& self);
  Waiter* Settle();
  Waiter* Dequeue();
  void EndStores();
  void BeginStores();

  // 0 clear; else set: holder << 2 | somebody_is_queued << 1 | 1. On a line of
  // its own, because tasks spin on it, with what they need besides.
  alignas(kCacheLine) std::atomic<std::uint64_t> state_{kClear};
  std::atomic<Clearing> clearing_{has_heavy_fence ? kByStore : kByExchange};
  std::atomic<std::uint32_t> num_exchanges_{0};  // since somebody was queued
  std::atomic<Waiter*> head_{nullptr};           // written under mutex_

  alignas(kCacheLine) mutable Mutex mutex_;  // guards the queue
  Waiter* tail_ = nullptr;
  int num_waiting_ = 0;
  const WaitPolicy policy_;
  const std::uint32_t number_ = NextNumber(ObjectKind::kLock);
};

inline bool Lock::TryOn() {
  // Behind those who are queued already.
  if (head_.load(std::memory_order_relaxed) != nullptr) return false;
  std::uint64_t expected = kClear;
  // Acquire: partner of the release in Off() and OffByExchange(). Relaxed on
  // failure: nothing is read under a lock that was not obtained.
  return state_.compare_exchange_strong(expected, SetBy(number_of_caller),
                                        std::memory_order_acquire,
                                        std::memory_order_relaxed);
}

inline void Lock::On() {
  if (IsTraced(TraceClass::kLocks)) [[unlikely]] {
    return OnTraced();
  }
  if (!TryOn()) AwaitTurn();
}

inline void Lock::Off() {
  // The number, on another line, only now.
  if (IsTraced(TraceClass::kLocks)) [[unlikely]] {
    Record(TraceAction::kLockOff, TraceData(number_));
  }
  if (clearing_.load(std::memory_order_relaxed) != kByStore) {
    return OffByExchange();
  }
  // Release: partner of the acquire in TryOn() and Settle().
  state_.store(kClear, std::memory_order_release);
  LightFence();  // Partner of the heavy one in EndStores().
  if (clearing_.load(std::memory_order_relaxed) != kByStore) HelpQueue();
}

inline bool Lock::Test() {
  // The load keeps the line shared among those who spin; a failing CAS would
  // fetch it exclusively every time.
  const bool was_set =
      state_.load(std::memory_order_relaxed) != kClear || !TryOn();
  if (IsTraced(TraceClass::kLocks)) [[unlikely]] {
    Record(was_set ? TraceAction::kLockTestSet : TraceAction::kLockTestOn,
           TraceData(number_, was_set ? 1 : 0));
  }
  // As GiveWay() asks; here to spare the call.
  const bool others_run =
      processor_of_caller != nullptr || MoreTasksThanProcessors();
  if (was_set && others_run) GiveWay();
  return was_set;
}

inline bool Lock::is_set() const {
  return state_.load(std::memory_order_relaxed) != kClear;
}

inline std::uint32_t Lock::holder() const {
  return static_cast<std::uint32_t>(state_.load(std::memory_order_relaxed) >>
                                    2);
}

}  // namespace macrotask
