#pragma once

#include <atomic>
#include <cstdint>
#include <memory>

#include "macrotask/cache_line.h"
#include "macrotask/wait_policy.h"
#include "macrotask/waited_object.h"

namespace macrotask {

// Internal: a barrier for more tasks than processors, each of them a pthread.
// First come the tasks of one processor: all but the last to arrive sleep. Then
// the processors: that last task has its processor to itself, watches for the
// others, and wakes those who sleep there, which no other processor has to be
// asked for. Same contract as Barrier.
//
// Which tasks belong together is what RunTasks() has placed together; tasks
// that are not placed form one more group, and all sleep.
class TwoLevelBarrier {
 public:
  // Requires: `num_tasks` >= 1. `number` is that of the Barrier.
  TwoLevelBarrier(int num_tasks, const WaitPolicy& policy,
                  std::uint32_t number);
  ~TwoLevelBarrier();
  TwoLevelBarrier(const TwoLevelBarrier&) = delete;
  TwoLevelBarrier& operator=(const TwoLevelBarrier&) = delete;

  void Sync();

  // Number of tasks that have arrived and whose phase is not complete.
  int num_waiting() const;

 private:
  // The tasks of one processor.
  struct alignas(kCacheLine) Group {
    // End of the phase for which a task of the group watches.
    std::atomic<std::uint64_t> watched{0};
    // num_asleep << 32 | wake_ups: those who sleep and have not been woken, and
    // what they sleep on, the number of times that those were all woken.
    std::atomic<std::uint64_t> sleepers{0};
  };

  bool IsComplete(std::uint64_t end_of_phase) const;
  void Release(const Group& own, std::uint64_t end_of_phase);
  void WakeSleepers(Group& group);
  void SleepUntil(Group& group, std::uint64_t end_of_phase);

  alignas(kCacheLine) std::atomic<std::uint64_t> arrivals_{0};

  alignas(kCacheLine) const std::uint64_t num_tasks_;
  const WaitPolicy policy_;
  const WaitedObject waited_;
  const int num_groups_;
  std::unique_ptr<Group[]> groups_;  // (num_groups_)
};

}  // namespace macrotask
