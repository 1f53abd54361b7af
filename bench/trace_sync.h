#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "bench/trace_history.h"

// Who let whom wait.

namespace bench {

// A wait for an event and the post that ended it: the first one during it.
struct EventWake {
  TraceWait wait;
  macrotask::TraceRecord post;
};

// In the order of the waits. One for an event that was posted already has none.
std::vector<EventWake> FindWakes(const TraceHistory& history);

// A task holds a lock, from LOCKON end, or LOCKTEST that found it clear, to
// LOCKOFF, or to the end of the trace.
struct LockHold {
  std::uint32_t lock;
  std::uint32_t task;
  std::uint64_t begin;
  std::uint64_t end;
  std::uint64_t contended;  // ticks during which others waited for it

  friend bool operator==(const LockHold&, const LockHold&) = default;
};

// In the order of the ends.
std::vector<LockHold> FindHolds(const TraceHistory& history);

}  // namespace bench
