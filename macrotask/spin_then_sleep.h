#pragma once

#include <sched.h>

#include <chrono>

#include "macrotask/load.h"
#include "macrotask/wait_policy.h"

namespace macrotask {

// Pauses between two looks at the clock. A pause takes 24 ns and the clock 28
// ns on a Zen 3 class guest: 16 keep the clock below a tenth of the time spun
// and bound the spin to within 0.4 us.
inline constexpr int kPausesPerLook = 16;

// Internal: tells the processor that this is a spin loop.
inline void Pause() {
#if defined(__x86_64__) || defined(__i386__)
  __builtin_ia32_pause();
#elif defined(__aarch64__)
  asm volatile("isb");
#endif
}

// Internal: spins until `done()`, as `policy` allows, and says whether it was
// done.
template <typename Done>
bool SpinUntil(const WaitPolicy& policy, const Done& done) {
  using Clock = std::chrono::steady_clock;
  const bool may_sleep = policy.kind != WaitKind::kSpin;
  Clock::time_point start;
  for (int looks = 0;; ++looks) {
    // Too few processors: whoever will make it `done()` may be waiting for
    // ours.
    const bool crowded = MoreTasksThanProcessors();
    if (crowded && may_sleep) return false;
    if (crowded) sched_yield();
    for (int i = 0; i < (crowded ? 1 : kPausesPerLook); ++i) {
      if (done()) return true;
      Pause();
    }
    if (!may_sleep) continue;
    // The first look only starts the clock: short waits never read it.
    const Clock::time_point now = Clock::now();
    if (looks == 0) start = now;
    if (now - start >= policy.hold_time) return false;
  }
}

// Internal: the one way in which a task of this library waits. Returns once
// `done()` is true or `sleep()` has returned; `sleep()` must return only when
// the wait is over, and is called at most once.
//
// Whatever a program wants to know about waiting tasks (a trace, a deadlock) or
// to do with their processor (run another task on it) belongs here.
template <typename Done, typename Sleep>
void SpinThenSleep(const WaitPolicy& policy, const Done& done,
                   const Sleep& sleep) {
  if (done()) return;
  if (policy.kind != WaitKind::kBlock && SpinUntil(policy, done)) return;
  sleep();
}

}  // namespace macrotask
