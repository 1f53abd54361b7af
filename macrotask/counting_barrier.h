#pragma once

#include <atomic>
#include <cstdint>

#include "macrotask/cache_line.h"
#include "macrotask/mutex.h"
#include "macrotask/wait_policy.h"
#include "macrotask/waited_object.h"

namespace macrotask {

// Internal: a barrier that counts arrivals and never starts the count again.
// The arrival that completes a phase is itself the release: one atomic
// read-modify-write per task, and all who wait read that one line. Same
// contract as Barrier.
class CountingBarrier {
 public:
  // Requires: `num_tasks` >= 1. `number` is that of the Barrier.
  CountingBarrier(int num_tasks, const WaitPolicy& policy, std::uint32_t number)
      : num_tasks_(static_cast<std::uint64_t>(num_tasks)),
        policy_(policy),
        waited_{ObjectKind::kBarrier, number} {}
  CountingBarrier(const CountingBarrier&) = delete;
  CountingBarrier& operator=(const CountingBarrier&) = delete;

  void Sync();

  // Number of tasks that have arrived and whose phase is not complete.
  int num_waiting() const;

 private:
  void WakeSleepers();
  void SleepUntil(std::uint64_t end_of_phase);

  // arrivals << 1 | somebody_sleeps, on a line of its own.
  alignas(kCacheLine) std::atomic<std::uint64_t> word_{0};

  alignas(kCacheLine) const std::uint64_t num_tasks_;
  const WaitPolicy policy_;
  const WaitedObject waited_;
  Mutex mutex_;
  Condition wake_;
};

}  // namespace macrotask
