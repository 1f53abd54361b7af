#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "bench/trace_waits.h"
#include "macrotask/trace_file.h"

namespace bench {

// A task, from the beginning of its body, or from its first record where that
// is not there, to its end, or to the end of the trace.
struct TaskSpan {
  std::uint32_t task;
  std::uint64_t begin;
  std::uint64_t end;
  bool begun;  // its beginning is in the trace
  bool ended;  // before the end of the trace

  friend bool operator==(const TaskSpan&, const TaskSpan&) = default;
};

// A trace and what all reports need to know of it.
struct TraceHistory {
  macrotask::Trace trace;
  std::vector<macrotask::TraceRecord> records;    // in time order
  std::vector<TraceWait> waits;                   // in order of beginning
  std::vector<TaskSpan> spans;                    // by task, then in time
  std::map<std::uint32_t, std::uint64_t> values;  // task: user value
  std::uint64_t begin = 0;
  std::uint64_t end = 0;
  std::uint64_t complete_from = 0;  // from here on no record was lost
  std::uint64_t num_lost = 0;

  // Microseconds since recording was switched on, and between two clocks.
  double Us(std::uint64_t clock) const { return trace.Seconds(clock) * 1e6; }
  double UsOf(std::uint64_t ticks) const {
    return static_cast<double>(ticks) / trace.ticks_per_second * 1e6;
  }
};

TraceHistory MakeHistory(macrotask::Trace trace);

// "task 2 (VALUE)".
std::string TaskText(const TraceHistory& history, std::uint32_t task);

}  // namespace bench
