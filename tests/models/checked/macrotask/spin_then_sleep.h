#pragma once

// In place of macrotask/spin_then_sleep.h: of every policy at once but the one
// that never sleeps, and without a clock. The wait is not published;
// deadlock_check.cc does that.

#include "macrotask/wait_policy.h"
#include "macrotask/waited_object.h"

namespace macrotask {

template <typename Done, typename Sleep, typename Crowded>
void SpinThenSleep(const WaitPolicy& policy, const WaitedObject&,
                   const Done& done, const Sleep& sleep,
                   const Crowded& is_crowded) {
  if (done()) return;
  // 2: no end to it.
  const unsigned most_looks = policy.kind == WaitKind::kSpin ? 2 : rl::rand(3);
  for (unsigned looks = 0; looks < most_looks || most_looks == 2; ++looks) {
    if (is_crowded()) break;
    if (done()) return;
    rl::yield(1, RL_INFO);
  }
  sleep();
}

template <typename Done, typename Sleep>
void SpinThenSleep(const WaitPolicy& policy, const WaitedObject& what,
                   const Done& done, const Sleep& sleep) {
  SpinThenSleep(policy, what, done, sleep, [] { return false; });
}

}  // namespace macrotask
