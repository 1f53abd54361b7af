#include "macrotask/counting_barrier.h"

#include "macrotask/spin_then_sleep.h"

// With n tasks, phase k (from 0) is complete when (k + 1) n arrivals are
// counted.
//
// Phases do not mix: a task arrives for phase k + 1 only after its phase k is
// complete, so the arrivals number k n .. (k + 1) n - 1 are one of each task,
// and old / n is the caller's phase. The count may be up to n - 1 past the end
// of a phase when a slow waiter looks, hence >= and never ==.
//
// Nothing has to be reset, so there is no moment at which a task that is late
// in leaving meets one that is early in coming back.
//
// No sleeper is lost: it sets the bit, or finds it set, under the mutex and in
// a word whose count is short of its phase. Only WakeSleepers() clears the bit,
// also under the mutex, and then wakes everybody: a sleeper of the next phase
// among them looks again, and either finds its phase complete or sets the bit
// anew before it sleeps. So the arrival that completes a sleeper's phase either
// sees the bit and comes for the mutex, or comes between such a clearing and
// that second look, which then finds the phase complete.

namespace macrotask {
namespace {

constexpr std::uint64_t kSomebodySleeps = 1;
constexpr std::uint64_t kOneArrival = 2;

std::uint64_t ArrivalsOf(std::uint64_t word) { return word >> 1; }

}  // namespace

void CountingBarrier::Sync() {
  if (num_tasks_ == 1) return;
  // Release: partner of the acquire loads below and in SleepUntil(). Acquire:
  // the last to arrive sees what the others wrote.
  const std::uint64_t word =
      word_.fetch_add(kOneArrival, std::memory_order_acq_rel);
  const std::uint64_t arrivals = ArrivalsOf(word);
  const std::uint64_t end_of_phase = (arrivals / num_tasks_ + 1) * num_tasks_;
  if (arrivals + 1 == end_of_phase) {
    if (word & kSomebodySleeps) WakeSleepers();
    return;
  }
  const auto phase_complete = [&] {
    // Acquire: partner of the release of every arrival of this phase.
    return ArrivalsOf(word_.load(std::memory_order_acquire)) >= end_of_phase;
  };
  SpinThenSleep(policy_, waited_, phase_complete,
                [&] { SleepUntil(end_of_phase); });
}

int CountingBarrier::num_waiting() const {
  return static_cast<int>(ArrivalsOf(word_.load(std::memory_order_relaxed)) %
                          num_tasks_);
}

void CountingBarrier::WakeSleepers() {
  {
    const MutexGuard guard(mutex_);
    // Relaxed: the bit publishes nothing, the mutex does.
    word_.fetch_and(~kSomebodySleeps, std::memory_order_relaxed);
  }
  // Outside the guard, so that those woken do not queue for the mutex; the
  // barrier outlives this call.
  wake_.WakeAll();
}

void CountingBarrier::SleepUntil(std::uint64_t end_of_phase) {
  const MutexGuard guard(mutex_);
  for (;;) {
    // Acquire: as in Sync().
    std::uint64_t word = word_.load(std::memory_order_acquire);
    if (ArrivalsOf(word) >= end_of_phase) return;
    // Relaxed: as in WakeSleepers(). An arrival in between makes it fail: look
    // again.
    if (!(word & kSomebodySleeps) &&
        !word_.compare_exchange_weak(word, word | kSomebodySleeps,
                                     std::memory_order_relaxed)) {
      continue;
    }
    wake_.Wait(mutex_);
  }
}

}  // namespace macrotask
