#pragma once

#include <sched.h>

#include <chrono>

#include "macrotask/load.h"
#include "macrotask/logical_wait.h"
#include "macrotask/published_wait.h"
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

// Internal: whether it is `done()` within the time of one look at the clock.
template <typename Done>
bool SpinBriefly(const Done& done) {
  for (int i = 0; i < kPausesPerLook; ++i) {
    if (done()) return true;
    Pause();
  }
  return false;
}

// Internal: spins until `done()`, as `policy` allows, and says whether it was
// done.
template <typename Done, typename Crowded>
bool SpinUntil(const WaitPolicy& policy, const PublishedWait& wait,
               const Done& done, const Crowded& is_crowded) {
  using Clock = std::chrono::steady_clock;
  constexpr int kLooksPerSearch = 4096;  // for a deadlock: 1.6 ms or more
  const bool may_sleep = policy.kind != WaitKind::kSpin;
  const Clock::time_point start =
      may_sleep ? Clock::now() : Clock::time_point();
  for (int looks = 1;; ++looks) {
    // Too few processors: whoever will make it `done()` may be waiting for
    // ours.
    const bool crowded = is_crowded();
    if (crowded && may_sleep) return false;
    if (crowded) sched_yield();
    if (crowded ? done() : SpinBriefly(done)) return true;
    if (may_sleep && Clock::now() - start >= policy.hold_time) return false;
    if (looks % kLooksPerSearch == 0) wait.Look();
  }
}

// Internal: the one way in which a task of this library waits, but for the
// pthread_barrier_t of BlockingBarrier. Returns once
// `done()` is true or `sleep()` has returned; `sleep()` must return only when
// the wait is over, and is called at most once. Once `done()` is true it must
// stay true, whoever asks. `what` is what the task says it waits for.
//
// A short wait costs nothing but the wait; a long one is published, so that a
// deadlock can be found. `is_crowded()` says whether others want the caller's
// processor.
template <typename Done, typename Sleep, typename Crowded>
void SpinThenSleep(const WaitPolicy& policy, const WaitedObject& what,
                   const Done& done, const Sleep& sleep,
                   const Crowded& is_crowded) {
  if (done()) return;
  if (processor_of_caller != nullptr) {
    const auto is_over = [](const void* wait) {
      return (*static_cast<const Done*>(wait))();
    };
    return WaitLogically(what, is_over, &done);
  }
  const bool may_spin = policy.kind != WaitKind::kBlock;
  if (may_spin && !is_crowded() && SpinBriefly(done)) return;
  const PublishedWait wait(what, done);
  if (may_spin && SpinUntil(policy, wait, done, is_crowded)) return;
  wait.BeginSleep();
  sleep();
  wait.EndSleep();
}

template <typename Done, typename Sleep>
void SpinThenSleep(const WaitPolicy& policy, const WaitedObject& what,
                   const Done& done, const Sleep& sleep) {
  SpinThenSleep(policy, what, done, sleep, &MoreTasksThanProcessors);
}

}  // namespace macrotask
