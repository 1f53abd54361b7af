#include "macrotask/lock.h"

#include "macrotask/epoch.h"

// Why nobody is lost.
//
// While the lock is cleared by exchange, the bit of the queue is set as long as
// somebody is queued: whoever clears the lock either finds the bit, and passes
// the lock on without clearing it, or clears it before anybody is queued, who
// then finds it clear.
//
// A store is cheaper, but may wipe the bit out. So the first one to queue ends
// the stores, and Off() asks once more after its store whether stores are
// allowed; if not, it helps the queue. It is not told wrong:
// - If it asks after the heavy fence of EndStores(), it learns of the end.
// - If it asks before, its store is before the fence as well, hence in the
//   memory when the queue begins behind the fence, and wipes out nothing.
// Stores begin again only with an empty queue, and never end without a fence:
// whoever is told that they are allowed again has nobody to help.
//
// A bit may be missing, then, but only while somebody is in Off() who is going
// to help. This task runs, so that there is no false alarm of a deadlock.
//
// First come, first served: TryOn() fails as long as somebody is queued, also
// while the lock is clear because a bit has been wiped out.

namespace macrotask {

// A task in the queue; lives on its stack.
struct Lock::Waiter {
  Epoch handed_over;
  Waiter* next = nullptr;
  const std::uint32_t task = RecordOfCaller().number();
};

void Lock::OnTraced() {
  RecordWait(TraceAction::kLockOn, TraceAction::kLockOnEnd, TraceData(number_),
             [this] {
               if (!TryOn()) AwaitTurn();
             });
}

void Lock::AwaitTurn() {
  Waiter self;
  if (!Enqueue(self)) return;
  self.handed_over.AwaitPast(0, policy_, {ObjectKind::kLock, number_, this});
}

// Queues the caller and returns true, or returns false if it now holds the
// lock.
bool Lock::Enqueue(Waiter& self) {
  const MutexGuard guard(mutex_);
  ++num_waiting_;
  if (head_.load(std::memory_order_relaxed) != nullptr) {
    tail_->next = &self;
    tail_ = &self;
    return true;
  }
  EndStores();
  // Relaxed, as all of the queue: the mutex orders it.
  head_.store(&self, std::memory_order_relaxed);
  tail_ = &self;
  return Settle() == nullptr;
}

// Requires: mutex_, an empty queue.
void Lock::EndStores() {
  num_exchanges_.store(0, std::memory_order_relaxed);
  if (clearing_.load(std::memory_order_relaxed) == kByExchange) return;
  clearing_.store(kByExchange, std::memory_order_relaxed);
  HeavyFence();  // Partner of the light one in Off().
}

// By one who has found for long that nobody queues.
void Lock::BeginStores() {
  const MutexGuard guard(mutex_);
  if (head_.load(std::memory_order_relaxed) != nullptr) return;
  clearing_.store(kByStore, std::memory_order_relaxed);
}

// Gives a clear lock to the head of the queue, which it returns, or sees to it
// that the holder will know of the queue, and returns null.
// Requires: mutex_, somebody is queued.
Lock::Waiter* Lock::Settle() {
  const Waiter* const head = head_.load(std::memory_order_relaxed);
  const std::uint64_t handed_over =
      SetBy(head->task) | (head->next != nullptr ? kQueued : 0);
  std::uint64_t state = state_.load(std::memory_order_relaxed);
  // The holder may clear the lock meanwhile, and another task that has seen no
  // queue may take it: until one of the two steps has succeeded.
  while (!(state & kQueued)) {
    const bool is_clear = state == kClear;
    // Acquire: partner of the release in Off() and OffByExchange(), for the
    // head. Relaxed on failure: the next round looks again.
    if (state_.compare_exchange_weak(
            state, is_clear ? handed_over : state | kQueued,
            std::memory_order_acquire, std::memory_order_relaxed)) {
      return is_clear ? Dequeue() : nullptr;
    }
  }
  return nullptr;
}

// Requires: mutex_, somebody is queued.
Lock::Waiter* Lock::Dequeue() {
  Waiter* const head = head_.load(std::memory_order_relaxed);
  head_.store(head->next, std::memory_order_relaxed);
  --num_waiting_;
  return head;
}

void Lock::OffByExchange() {
  // Before the lock is clear: then others want the line. That unlockings at the
  // same time are counted once does no harm.
  const std::uint32_t num_exchanges =
      num_exchanges_.load(std::memory_order_relaxed) + 1;
  num_exchanges_.store(num_exchanges, std::memory_order_relaxed);
  // Nearly always; and a guess is cheaper than a look.
  std::uint64_t state = SetBy(number_of_caller);
  // Release: partner of the acquire in TryOn() and Settle(). A failure is
  // another task's lock, one that has queued itself, or one that unlocks as
  // well: look again.
  while (!(state & kQueued)) {
    if (state_.compare_exchange_strong(state, kClear, std::memory_order_release,
                                       std::memory_order_relaxed)) {
      if (has_heavy_fence && num_exchanges >= kLightFencesPerHeavyOne) {
        BeginStores();
      }
      return;
    }
  }
  HandOver();
}

void Lock::HandOver() {
  Waiter* next_holder = nullptr;
  {
    const MutexGuard guard(mutex_);
    if (head_.load(std::memory_order_relaxed) == nullptr) {
      // Somebody else has unlocked meanwhile: the same step once more, with the
      // same partner. Nobody can queue, which takes the mutex.
      state_.store(kClear, std::memory_order_release);
      return;
    }
    next_holder = Dequeue();
    // Relaxed: the lock stays set, so that nobody acquires from this store. The
    // new holder acquires from its epoch.
    state_.store(
        SetBy(next_holder->task) | (next_holder->next != nullptr ? kQueued : 0),
        std::memory_order_relaxed);
  }
  // The last touch: from here on the new holder may leave, and its stack with
  // the Waiter.
  next_holder->handed_over.Advance();
}

// By one who has cleared the lock by a store and may have wiped the bit of the
// queue out.
void Lock::HelpQueue() {
  Waiter* next_holder = nullptr;
  {
    const MutexGuard guard(mutex_);
    if (head_.load(std::memory_order_relaxed) == nullptr) return;
    next_holder = Settle();
  }
  if (next_holder != nullptr) next_holder->handed_over.Advance();
}

int Lock::num_waiting() const {
  const MutexGuard guard(mutex_);
  return num_waiting_;
}

}  // namespace macrotask
