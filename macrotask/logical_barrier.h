#pragma once

#include <atomic>
#include <cstdint>

#include "macrotask/cache_line.h"
#include "macrotask/logical_processor.h"
#include "macrotask/task_record.h"

namespace macrotask {

// Internal: a barrier for tasks that take turns on few processors. Each
// processor counts the arrivals of its own tasks without atomics and publishes
// the sum on a line of its own; the phase is complete when the lines of all
// processors add up. Same contract as Barrier. A pthread that is no logical
// task may take part; it counts at once, and yields while it waits.
class LogicalBarrier {
 public:
  // Requires: `num_tasks` >= 1. `number` is that of the Barrier.
  LogicalBarrier(int num_tasks, std::uint32_t number)
      : num_tasks_(static_cast<std::uint64_t>(num_tasks)),
        waited_{ObjectKind::kBarrier, number} {}
  LogicalBarrier(const LogicalBarrier&) = delete;
  LogicalBarrier& operator=(const LogicalBarrier&) = delete;

  void Sync();

  // Number of tasks that have arrived and whose phase is not complete.
  int num_waiting() const;

  // By the processor: publishes what it has counted and not published.
  void Publish(LogicalProcessor* processor);

 private:
  // What a processor counts; its own.
  struct alignas(kCacheLine) Count {
    std::uint64_t pending = 0;       // arrivals that are not published
    std::uint64_t end_of_phase = 0;  // of those, and of the last published ones
    std::uint64_t arrived = 0;       // in that phase
    std::uint64_t expected = 0;      // arrived in the phase before
  };
  // What it publishes: arrivals since the beginning.
  struct alignas(kCacheLine) Line {
    std::atomic<std::uint64_t> arrivals{0};
  };

  std::uint64_t NumArrivals() const;
  void SyncOfPthread();
  void Wait(std::uint64_t end_of_phase);

  const std::uint64_t num_tasks_;
  const WaitedObject waited_;
  std::atomic<std::uint64_t> slots_{0};  // those that ever took part, bits
  Line of_pthreads_;
  Line lines_[LogicalProcessor::kMostSlots];
  Count counts_[LogicalProcessor::kMostSlots];
};

}  // namespace macrotask
