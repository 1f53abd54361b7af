#pragma once

#include <atomic>
#include <cstdint>

#include "macrotask/cache_line.h"
#include "macrotask/spin_then_sleep.h"

// The least code that synchronizes at all: no sleep, no trace, no deadlock
// detection, no word for those who look from outside. What a construct costs
// beyond these is what it gives.

namespace bench {

// Spins, whoever else needs the processor.
template <typename Done>
void SpinOn(const Done& done) {
  while (!done()) macrotask::Pause();
}

// A barrier of two: each task has a line that only it writes.
class PairwiseFlags {
 public:
  explicit PairwiseFlags(int) {}

  void Sync(int task) {
    const std::uint64_t phase = ++*phases_[task];
    // Pairs with the acquire of the other task.
    flags_[task]->store(phase, std::memory_order_release);
    const std::atomic<std::uint64_t>& other = *flags_[1 - task];
    // Not ==: it may be one phase ahead.
    SpinOn([&] { return other.load(std::memory_order_acquire) >= phase; });
  }

 private:
  macrotask::CacheAligned<std::atomic<std::uint64_t>> flags_[2];
  // Each task's own count, not on the line that the other one reads: that would
  // be fetched twice in a phase.
  macrotask::CacheAligned<std::uint64_t> phases_[2];
};

// A barrier of any number: arrivals are counted and the count is the release.
class CentralCounter {
 public:
  explicit CentralCounter(int num_tasks)
      : num_tasks_(static_cast<std::uint64_t>(num_tasks)) {}

  void Sync(int) {
    const std::uint64_t before =
        arrivals_->fetch_add(1, std::memory_order_acq_rel);
    const std::uint64_t end = before - before % num_tasks_ + num_tasks_;
    SpinOn([&] { return arrivals_->load(std::memory_order_acquire) >= end; });
  }

 private:
  const std::uint64_t num_tasks_;
  macrotask::CacheAligned<std::atomic<std::uint64_t>> arrivals_;
};

class FlagEvent {
 public:
  void Post() { flag_->store(true, std::memory_order_release); }
  void Wait() {
    SpinOn([&] { return flag_->load(std::memory_order_acquire); });
  }
  void Clear() { flag_->store(false, std::memory_order_relaxed); }

 private:
  macrotask::CacheAligned<std::atomic<bool>> flag_;
};

class ExchangeLock {
 public:
  // Returns true if the lock was set already.
  bool Test() { return set_->exchange(true, std::memory_order_acquire); }
  void On() {
    while (Test()) {
      SpinOn([&] { return !set_->load(std::memory_order_relaxed); });
    }
  }
  void Off() { set_->store(false, std::memory_order_release); }

 private:
  macrotask::CacheAligned<std::atomic<bool>> set_;
};

// A message there and back on one line: what the machine needs to move a line
// from one processor to the other and back.
class RoundTrip {
 public:
  void Call(int task) {
    if (task == 0) {
      const std::uint64_t back = word_->load(std::memory_order_relaxed) + 2;
      word_->store(back - 1, std::memory_order_release);
      SpinOn([&] { return word_->load(std::memory_order_acquire) == back; });
      return;
    }
    SpinOn([&] { return word_->load(std::memory_order_acquire) % 2 == 1; });
    const std::uint64_t there = word_->load(std::memory_order_relaxed);
    word_->store(there + 1, std::memory_order_release);
  }

 private:
  macrotask::CacheAligned<std::atomic<std::uint64_t>> word_;
};

}  // namespace bench
