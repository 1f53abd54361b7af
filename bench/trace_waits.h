#pragma once

#include <cstdint>
#include <vector>

#include "macrotask/trace_file.h"
#include "macrotask/trace_text.h"

namespace bench {

// From the record that begins a wait, or a sleep, to the one that ends it.
struct TraceWait {
  macrotask::TraceAction action;  // kBarrierSync, kLockOn, ... or kSleep
  macrotask::TraceObject object;  // none for kSleep
  std::uint32_t task;
  std::uint64_t begin;
  std::uint64_t end;
  bool finished;  // if not, `end` is that of the trace
  int depth;      // how many other waits of the task it is inside of

  friend bool operator==(const TraceWait&, const TraceWait&) = default;
};

// The waits of all tasks in the order in which they begin. `records` are in
// time order, `end` is the end of the trace.
//
// An end whose beginning is not there is left out, and so is a beginning whose
// end was not recorded: the task ended, waited for the same again, left a wait
// around this one, or, if it slept, did anything else.
std::vector<TraceWait> PairWaits(
    const std::vector<macrotask::TraceRecord>& records, std::uint64_t end);

}  // namespace bench
