#pragma once

#include <atomic>

namespace macrotask {

// Internal: two fences that belong together, of which the light one costs
// nothing. Of two tasks that each write something and then look at what the
// other one writes, one with LightFence() between the two and the other with
// HeavyFence(), at least one sees what the other has written. Two light ones
// promise nothing.
//
// Source: membarrier(2); asymmetric_thread_fence_light and _heavy of P1202.
// Use: any task; HeavyFence() only if `has_heavy_fence`.
// Cost: the light one keeps only the compiler from reordering. The heavy one
// makes up for the processors: it interrupts every other one that runs a
// pthread of this process. 11 us on a 2-processor KVM guest (Zen 3 class), 0.4
// us if no other one does.
inline void LightFence() {
  std::atomic_signal_fence(std::memory_order_seq_cst);
}

// Ends the program if the system refuses now what it has promised.
void HeavyFence() noexcept;

// Whether the system has such a fence. False until the library is loaded, and
// for ever under old kernels and filters of system calls.
extern const bool has_heavy_fence;

// So many light fences, each in place of an atomic read-modify-write of 2 to 3
// ns, have earned one heavy fence.
inline constexpr int kLightFencesPerHeavyOne = 4096;

}  // namespace macrotask
