#pragma once

// In place of macrotask/spin_then_sleep.h: of every policy at once, and without
// a clock. The wait is not published; deadlock_check.cc does that.

#include "macrotask/wait_policy.h"
#include "macrotask/waited_object.h"

namespace macrotask {

template <typename Done, typename Sleep>
void SpinThenSleep(const WaitPolicy&, const WaitedObject&, const Done& done,
                   const Sleep& sleep) {
  if (done()) return;
  const unsigned most_looks = rl::rand(3);  // 2: no end to it
  for (unsigned looks = 0; looks < most_looks || most_looks == 2; ++looks) {
    if (done()) return;
    rl::yield(1, RL_INFO);
  }
  sleep();
}

}  // namespace macrotask
