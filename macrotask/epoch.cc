#include "macrotask/epoch.h"

#include <algorithm>

#include "macrotask/spin_then_sleep.h"

// Why a sleeper is neither lost nor left with a destroyed object.
//
// The bit is set only under the mutex, by a CAS on a word whose epoch is not
// past `seen`, and is cleared only by the advance that ends this epoch. That
// advance therefore sees it, and then takes the mutex, which the sleeper gives
// up only inside the condition variable: the broadcast finds it there. The
// exchange of AdvanceTo() is such an advance: there is no other one whose epoch
// it could overwrite, and a bit set before it is in the word that it returns.
//
// An advance that saw the bit touches the object after its atomic step. A
// sleeper therefore waits for `released_`, which that advance writes under the
// mutex as the last thing but the unlocking, and not for the word, which
// changes before. An advance that did not see the bit touches nothing more, so
// that one who spins may return as soon as the word has changed.

namespace macrotask {
namespace {

constexpr std::uint64_t kSomebodySleeps = 1;

std::uint64_t EpochOf(std::uint64_t word) { return word >> 1; }

std::uint64_t WordOf(std::uint64_t epoch) { return epoch << 1; }

}  // namespace

std::uint64_t Epoch::Read() const {
  // Acquire: partner of the release in Advance(), AdvanceTo() and AdvanceIf().
  return EpochOf(word_.load(std::memory_order_acquire));
}

void Epoch::Advance() {
  std::uint64_t word = word_.load(std::memory_order_relaxed);
  // Release: partner of the acquire in Read() and SleepPast(). Acquire: a task
  // that advances has seen what the one before it wrote.
  while (!word_.compare_exchange_weak(word, WordOf(EpochOf(word) + 1),
                                      std::memory_order_acq_rel,
                                      std::memory_order_relaxed)) {
  }
  if (word & kSomebodySleeps) WakeSleepers(EpochOf(word) + 1);
}

void Epoch::AdvanceTo(std::uint64_t epoch) {
  // Release: as in Advance(). No acquire: nobody else has advanced it.
  const std::uint64_t word =
      word_.exchange(WordOf(epoch), std::memory_order_release);
  if (word & kSomebodySleeps) WakeSleepers(epoch);
}

void Epoch::AdvanceIf(std::uint64_t parity) {
  std::uint64_t word = word_.load(std::memory_order_relaxed);
  std::uint64_t next;
  // A word of the other parity is written back unchanged. To leave it alone
  // would lose wake-ups: `data = 1; Post()` beside `Clear(); if (!data) Wait()`
  // could read the old "posted" before its own store to `data` is visible, do
  // nothing, and leave the other task waiting. As a write it comes either
  // before the clear, which then sees `data`, or after it, and posts.
  // Release and acquire: partner of each other, and of Read().
  do {
    const std::uint64_t epoch = EpochOf(word);
    next = epoch % 2 == parity ? WordOf(epoch + 1) : word;
  } while (!word_.compare_exchange_weak(word, next, std::memory_order_acq_rel,
                                        std::memory_order_relaxed));
  if (next != word && (word & kSomebodySleeps)) WakeSleepers(EpochOf(next));
}

void Epoch::AwaitPast(std::uint64_t seen, const WaitPolicy& policy,
                      const WaitedObject& what) {
  SpinThenSleep(
      policy, what, [&] { return Read() > seen; }, [&] { SleepPast(seen); });
}

void Epoch::WakeSleepers(std::uint64_t epoch) {
  const MutexGuard guard(mutex_);
  // Of two advances the later may get here first.
  released_ = std::max(released_, epoch);
  // Inside the guard: a sleeper that ran between the unlocking and the
  // broadcast could destroy the condition variable.
  wake_.WakeAll();
}

void Epoch::SleepPast(std::uint64_t seen) {
  const MutexGuard guard(mutex_);
  std::uint64_t word = word_.load(std::memory_order_acquire);  // as in Read()
  while (EpochOf(word) <= seen && !(word & kSomebodySleeps)) {
    // Acquire: as in Read(), for the word that makes it fail.
    if (word_.compare_exchange_weak(word, word | kSomebodySleeps,
                                    std::memory_order_acquire)) {
      break;
    }
  }
  if (EpochOf(word) > seen) return;
  while (released_ <= seen) wake_.Wait(mutex_);
}

}  // namespace macrotask
