#pragma once

// In place of macrotask/trace_point.h: nothing is traced.

#include <cstdint>

#include "macrotask/trace_record.h"

namespace macrotask {

inline std::uint64_t TraceData(std::uint32_t, std::uint64_t = 0) { return 0; }

inline bool IsTraced(TraceClass) { return false; }

inline void Record(TraceAction, std::uint64_t) {}

inline void RecordIf(TraceClass, TraceAction, std::uint64_t) {}

template <typename Wait>
void RecordWait(TraceAction, TraceAction, std::uint64_t, const Wait& wait) {
  wait();
}

template <typename Wait>
void RecordAround(TraceClass, TraceAction, TraceAction, std::uint64_t,
                  const Wait& wait) {
  wait();
}

}  // namespace macrotask
