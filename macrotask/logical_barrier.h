#pragma once

#include <atomic>
#include <bit>
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

  // Whether so many have arrived since the beginning. By anyone; and by the
  // processor with `slot`, which asks the others' lines only as long as the
  // answer is no.
  bool IsPast(std::uint64_t end_of_phase) const {
    return NumArrivals() >= end_of_phase;
  }
  bool IsPast(std::uint64_t end_of_phase, int slot);

 private:
  // What a processor counts; its own.
  struct alignas(kCacheLine) Count {
    std::uint64_t complete = 0;      // arrivals of phases known to be complete
    std::uint64_t end_of_phase = 0;  // of the last arrival
    std::uint64_t pending = 0;       // arrivals that are not published
    std::uint64_t arrived = 0;       // in that phase
    std::uint64_t expected = 0;      // arrived in the phase before
  };
  // What it publishes: arrivals since the beginning.
  struct alignas(kCacheLine) Line {
    std::atomic<std::uint64_t> arrivals{0};
  };
  static constexpr int kSlotOfPthreads = LogicalSlot::kMost;
  static constexpr int kNumLines = kSlotOfPthreads + 1;
  static_assert(kNumLines <= 64, "one bit each");

  std::uint64_t NumArrivals() const;
  std::uint64_t EndOfPhase() const;
  void TakePart(int slot);
  void SyncFirst(LogicalProcessor* processor, Count& count);
  void SyncNext(LogicalProcessor* processor, Count& count);
  void SyncLast(LogicalProcessor* processor, Count& count);
  void SyncOfPthread();

  const std::uint64_t num_tasks_;
  const WaitedObject waited_;
  std::atomic<std::uint64_t> slots_{0};  // those that ever took part, bits
  Line lines_[kNumLines];
  Count counts_[kNumLines];
};

inline std::uint64_t LogicalBarrier::NumArrivals() const {
  std::uint64_t sum = 0;
  // Acquire: partner of the release in TakePart(); below, of that in Publish()
  // and SyncOfPthread().
  std::uint64_t slots = slots_.load(std::memory_order_acquire);
  for (; slots != 0; slots &= slots - 1) {
    sum += lines_[std::countr_zero(slots)].arrivals.load(
        std::memory_order_acquire);
  }
  return sum;
}

inline bool LogicalBarrier::IsPast(std::uint64_t end_of_phase, int slot) {
  Count& count = counts_[slot];
  if (count.complete >= end_of_phase) return true;
  if (!IsPast(end_of_phase)) return false;
  count.complete = end_of_phase;
  return true;
}

}  // namespace macrotask
