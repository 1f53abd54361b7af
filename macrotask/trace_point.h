#pragma once

#include <atomic>
#include <cstdint>

#include "macrotask/cache_line.h"
#include "macrotask/trace_record.h"

// Internal: how the classes of this library write into the history trace.

namespace macrotask {

// Internal: the classes that are recorded, on a line that nobody writes.
alignas(kCacheLine) inline constinit std::atomic<std::uint32_t> traced_classes{
    0};

inline bool IsTraced(TraceClass trace_class) {
  return (traced_classes.load(std::memory_order_relaxed) &
          static_cast<std::uint32_t>(trace_class)) != 0;
}

// Internal: the data word of an object.
inline constexpr std::uint64_t TraceData(std::uint32_t object,
                                         std::uint64_t detail = 0) {
  return detail << 32 | object;
}

// Internal: writes a record for the calling task.
void Record(TraceAction action, std::uint64_t data);

inline void RecordIf(TraceClass trace_class, TraceAction action,
                     std::uint64_t data) {
  if (IsTraced(trace_class)) [[unlikely]] {
    Record(action, data);
  }
}

// Internal: runs `wait()` with a record before and one after it. One branch
// when nothing is recorded.
template <typename Wait>
[[gnu::noinline]] void RecordWait(TraceAction begin, TraceAction end,
                                  std::uint64_t data, const Wait& wait) {
  Record(begin, data);
  wait();
  Record(end, data);
}
template <typename Wait>
void RecordAround(TraceClass trace_class, TraceAction begin, TraceAction end,
                  std::uint64_t data, const Wait& wait) {
  if (IsTraced(trace_class)) [[unlikely]] {
    return RecordWait(begin, end, data, wait);
  }
  wait();
}

}  // namespace macrotask
