#include "macrotask/lock.h"

#include <sched.h>

#include "macrotask/epoch.h"
#include "macrotask/load.h"

// First come, first served: the state is 2 exactly while the queue is not empty
// (both change under the mutex), hence never 0 while somebody is queued, and
// nobody who comes later gets past the CAS from 0. Off() finds 2 and passes the
// lock on without clearing it.

namespace macrotask {
namespace {

constexpr std::uint32_t kClear = 0;
constexpr std::uint32_t kSet = 1;
constexpr std::uint32_t kSetWithQueue = 2;

}  // namespace

// A task in the queue; lives on its stack.
struct Lock::Waiter {
  Epoch handed_over;
  Waiter* next = nullptr;
};

bool Lock::TryOn() {
  std::uint32_t expected = kClear;
  // Acquire: partner of the release in Off(). Relaxed on failure: nothing is
  // read under a lock that was not obtained.
  return state_.compare_exchange_strong(
      expected, kSet, std::memory_order_acquire, std::memory_order_relaxed);
}

// Queues the caller and returns true, or returns false if it now holds the
// lock.
bool Lock::Enqueue(Waiter& self) {
  const MutexGuard guard(mutex_);
  if (head_ == nullptr) {
    std::uint32_t state = kSet;
    // The holder may clear the lock as long as the state is 1, and another task
    // may take it again: until one of the two steps has succeeded. Relaxed: the
    // mutex orders the queue, the hand-over orders the data.
    while (!state_.compare_exchange_strong(state, kSetWithQueue,
                                           std::memory_order_relaxed)) {
      if (TryOn()) return false;
      state = kSet;
    }
    head_ = &self;
  } else {
    tail_->next = &self;
  }
  tail_ = &self;
  ++num_waiting_;
  return true;
}

void Lock::On() {
  if (TryOn()) return;
  Waiter self;
  if (Enqueue(self)) self.handed_over.AwaitPast(0, policy_);
}

void Lock::Off() {
  std::uint32_t expected = kSet;
  // Release: partner of the acquire in TryOn().
  if (state_.compare_exchange_strong(expected, kClear,
                                     std::memory_order_release,
                                     std::memory_order_relaxed)) {
    return;
  }
  Waiter* next_holder = nullptr;
  {
    const MutexGuard guard(mutex_);
    next_holder = head_;
    if (next_holder == nullptr) {
      // Somebody else unlocked meanwhile, or the lock was clear: the same step
      // once more, with the same partner.
      expected = kSet;
      state_.compare_exchange_strong(expected, kClear,
                                     std::memory_order_release,
                                     std::memory_order_relaxed);
      return;
    }
    head_ = next_holder->next;
    --num_waiting_;
    // Relaxed: the lock stays set, so that nobody acquires from this store. The
    // new holder acquires from its epoch.
    if (head_ == nullptr) state_.store(kSet, std::memory_order_relaxed);
  }
  // The last touch: from here on the new holder may leave, and its stack with
  // the Waiter.
  next_holder->handed_over.Advance();
}

bool Lock::Test() {
  // The load keeps the line shared among those who spin; a failing CAS would
  // fetch it exclusively every time.
  if (state_.load(std::memory_order_relaxed) == kClear && TryOn()) return false;
  if (MoreTasksThanProcessors()) sched_yield();
  return true;
}

int Lock::num_waiting() const {
  const MutexGuard guard(mutex_);
  return num_waiting_;
}

}  // namespace macrotask
