#pragma once

// In place of macrotask/futex.h: sleeping in relacy's scheduler. It orders
// nothing in memory, as little as the system promises to.

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>

namespace macrotask {

// On which word each task sleeps.
inline std::array<const std::atomic<std::uint64_t>*, 8> asleep_on;

inline constexpr bool kIsTimed = false;
inline constexpr bool kSwitches = false;  // at once to the one woken

// Before a program starts: the one before may have ended in a deadlock.
inline void ForgetSleepers() { asleep_on.fill(nullptr); }

inline void FutexWait(const std::atomic<std::uint64_t>& word,
                      std::uint32_t seen) {
  // What fails reads the newest value, as the system does.
  constexpr std::uint64_t kNever = ~std::uint64_t{0};
  std::uint64_t value = kNever;
  const_cast<std::atomic<std::uint64_t>&>(word).compare_exchange_strong(
      value, kNever, std::memory_order_relaxed, std::memory_order_relaxed);
  if (static_cast<std::uint32_t>(value) != seen) return;
  // Nobody else runs between the look and the sleep.
  asleep_on[rl::thread_index()] = &word;
  // Perhaps, for it must not hide that one is lost.
  const bool may_wake_for_no_reason = rl::rand(4) == 0;
  rl::ctx().park_current_thread(kIsTimed, may_wake_for_no_reason, kSwitches,
                                RL_INFO);
  asleep_on[rl::thread_index()] = nullptr;
}

inline void FutexWakeAll(const std::atomic<std::uint64_t>& word) {
  rl::ctx().sched();
  for (unsigned task = 0; task < asleep_on.size(); ++task) {
    if (asleep_on[task] != &word) continue;
    asleep_on[task] = nullptr;
    rl::ctx().unpark_thread(task, kSwitches, RL_INFO);
  }
}

}  // namespace macrotask
