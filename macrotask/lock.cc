#include "macrotask/lock.h"

#include "macrotask/epoch.h"
#include "macrotask/logical_wait.h"
#include "macrotask/task_registry.h"
#include "macrotask/trace_point.h"

// First come, first served: the bit of the queue is set exactly while the queue
// is not empty (both change under the mutex), hence the state is never 0 while
// somebody is queued, and nobody who comes later gets past the CAS from 0.
// Off() finds the bit and passes the lock on without clearing it.

namespace macrotask {
namespace {

constexpr std::uint64_t kClear = 0;
constexpr std::uint64_t kSet = 1;
constexpr std::uint64_t kQueued = 2;

constexpr std::uint64_t SetBy(std::uint32_t task) {
  return std::uint64_t{task} << 2 | kSet;
}

}  // namespace

// A task in the queue; lives on its stack.
struct Lock::Waiter {
  Epoch handed_over;
  Waiter* next = nullptr;
  const std::uint32_t task = RecordOfCaller().number();
};

bool Lock::TryOn() {
  std::uint64_t expected = kClear;
  // Acquire: partner of the release in Off(). Relaxed on failure: nothing is
  // read under a lock that was not obtained.
  return state_.compare_exchange_strong(expected, SetBy(number_of_caller),
                                        std::memory_order_acquire,
                                        std::memory_order_relaxed);
}

// Queues the caller and returns true, or returns false if it now holds the
// lock.
bool Lock::Enqueue(Waiter& self) {
  const MutexGuard guard(mutex_);
  if (head_ == nullptr) {
    std::uint64_t state = state_.load(std::memory_order_relaxed);
    // The holder may clear the lock as long as nobody is queued, and another
    // task may take it again: until one of the two steps has succeeded.
    // Relaxed: the mutex orders the queue, the hand-over orders the data.
    while (state == kClear ||
           !state_.compare_exchange_weak(state, state | kQueued,
                                         std::memory_order_relaxed)) {
      if (TryOn()) return false;
      state = state_.load(std::memory_order_relaxed);
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
  RecordAround(TraceClass::kLocks, TraceAction::kLockOn,
               TraceAction::kLockOnEnd, TraceData(number_),
               [this] { OnUntraced(); });
}

void Lock::OnUntraced() {
  if (TryOn()) return;
  Waiter self;
  if (!Enqueue(self)) return;
  self.handed_over.AwaitPast(0, policy_, {ObjectKind::kLock, number_, this});
}

void Lock::Off() {
  RecordIf(TraceClass::kLocks, TraceAction::kLockOff, TraceData(number_));
  // Nearly always; and a guess is cheaper than a look.
  std::uint64_t state = SetBy(number_of_caller);
  // Release: partner of the acquire in TryOn(). A failure is another task's
  // lock, one that has queued itself, or one that unlocks as well: look again.
  while (!(state & kQueued)) {
    if (state_.compare_exchange_strong(state, kClear, std::memory_order_release,
                                       std::memory_order_relaxed)) {
      return;
    }
  }
  Waiter* next_holder = nullptr;
  {
    const MutexGuard guard(mutex_);
    next_holder = head_;
    if (next_holder == nullptr) {
      // Somebody else has unlocked meanwhile: the same step once more, with the
      // same partner. Nobody can queue, which takes the mutex.
      state_.store(kClear, std::memory_order_release);
      return;
    }
    head_ = next_holder->next;
    --num_waiting_;
    // Relaxed: the lock stays set, so that nobody acquires from this store. The
    // new holder acquires from its epoch.
    state_.store(SetBy(next_holder->task) | (head_ != nullptr ? kQueued : 0),
                 std::memory_order_relaxed);
  }
  // The last touch: from here on the new holder may leave, and its stack with
  // the Waiter.
  next_holder->handed_over.Advance();
}

bool Lock::Test() {
  // The load keeps the line shared among those who spin; a failing CAS would
  // fetch it exclusively every time.
  const bool was_set =
      state_.load(std::memory_order_relaxed) != kClear || !TryOn();
  RecordIf(TraceClass::kLocks,
           was_set ? TraceAction::kLockTestSet : TraceAction::kLockTestOn,
           TraceData(number_, was_set ? 1 : 0));
  if (was_set) GiveWay();
  return was_set;
}

int Lock::num_waiting() const {
  const MutexGuard guard(mutex_);
  return num_waiting_;
}

bool Lock::is_set() const {
  return state_.load(std::memory_order_relaxed) != kClear;
}

std::uint32_t Lock::holder() const {
  return static_cast<std::uint32_t>(state_.load(std::memory_order_relaxed) >>
                                    2);
}

}  // namespace macrotask
