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
  void Append(const TraceRecord& record);

  // By anyone: what is in the ring, oldest first, without what the owner
  // overwrites meanwhile. Adds to `num_lost` what is not in it any more.
  std::vector<TraceRecord> Read(std::uint64_t* num_lost) const;

 private:
  struct Slot {
    std::uint64_t clock, data, rest;  // by std::atomic_ref
  };

  const std::size_t mask_;
  // By calloc(), so that the first record does not pay for all the others.
  const std::unique_ptr<Slot[], void (*)(void*)> slots_;
  alignas(kCacheLine) std::atomic<std::uint64_t> num_begun_{0};
  std::atomic<std::uint64_t> num_written_{0};
  // The owner's own: the last record.
  TraceAction last_action_ = TraceAction::kNone;
  std::uint32_t last_task_ = 0;
  std::uint64_t last_data_ = 0;
};

}  // namespace macrotask
