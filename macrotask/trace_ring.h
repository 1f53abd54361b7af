#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "macrotask/cache_line.h"
#include "macrotask/trace_record.h"

namespace macrotask {

// Internal: the last so many records of one pthread. One pthread appends,
// others may read at any time.
class TraceRing {
 public:
  // Requires: `capacity` is a power of two.
  explicit TraceRing(std::size_t capacity);
  TraceRing(const TraceRing&) = delete;
  TraceRing& operator=(const TraceRing&) = delete;

  // By the owner. A test that found the same as the same task's test just
  // before is counted in that one's record.
  void Append(const TraceRecord& record) {
    if (IsTest(record.action)) [[unlikely]] {
      AppendTest(record);
    } else {
      AppendNext(record);
    }
  }

  // By the owner, a record that is no test.
  void AppendNext(const TraceRecord& record);

  // By anyone: what is in the ring, oldest first, without what the owner
  // overwrites meanwhile. Adds to `num_lost` what is not in it any more.
  std::vector<TraceRecord> Read(std::uint64_t* num_lost) const;

 private:
  struct Slot {
    std::uint64_t clock, data, rest;  // by std::atomic_ref
  };

  static bool IsTest(TraceAction action) {
    return action == TraceAction::kLockTestSet ||
           action == TraceAction::kEventTest ||
           action == TraceAction::kEventTestClear;
  }
  static void Store(std::uint64_t& word, std::uint64_t value) {
    // Release: partner of the acquire in Load(), in the source.
    std::atomic_ref<std::uint64_t>(word).store(value,
                                               std::memory_order_release);
  }
  void AppendTest(const TraceRecord& record);

  const std::size_t mask_;
  // By calloc(), so that the first record does not pay for all the others.
  const std::unique_ptr<Slot[], void (*)(void*)> slots_;
  alignas(kCacheLine) std::atomic<std::uint64_t> num_begun_{0};
  std::atomic<std::uint64_t> num_written_{0};
  // The owner's own: the last record, and of the last test the rest.
  TraceAction last_action_ = TraceAction::kNone;
  std::uint32_t last_task_ = 0;
  std::uint64_t last_data_ = 0;
};

// Inline: a record of a wait is on the way of whoever waits for the caller.
inline void TraceRing::AppendNext(const TraceRecord& record) {
  const std::uint64_t number = num_begun_.load(std::memory_order_relaxed);
  last_action_ = record.action;
  num_begun_.store(number + 1, std::memory_order_relaxed);
  Slot& slot = slots_[number & mask_];
  Store(slot.clock, record.clock);
  Store(slot.data, record.data);
  Store(slot.rest, std::uint64_t{record.task} << 32 |
                       std::uint64_t{record.cpu} << 16 |
                       static_cast<std::uint64_t>(record.action));
  // Release: partner of the acquire in Read().
  num_written_.store(number + 1, std::memory_order_release);
}

}  // namespace macrotask
