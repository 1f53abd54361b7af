#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "bench/trace_history.h"

namespace bench {

// Once through a barrier, all its tasks.
struct BarrierPhase {
  std::uint32_t barrier;
  std::uint32_t last_task;
  std::uint64_t last;            // its arrival
  std::uint64_t second_to_last;  // that of the one before it; or `last`
  std::uint32_t num_tasks;

  friend bool operator==(const BarrierPhase&, const BarrierPhase&) = default;
};

struct BarrierPhases {
  std::vector<BarrierPhase> complete;  // by barrier, then in time
  // barrier: arrivals whose phase is not known or not all in the trace
  std::map<std::uint32_t, std::uint64_t> skipped;
};

// As many arrivals in time order as the barrier has tasks are a phase: nobody
// arrives for the next one before all have arrived for this one.
//
// Where records were lost, or recording began with tasks in the barrier, it is
// not known which arrival is the first of a phase. Then the one is taken for
// which nobody leaves before the last of his phase has arrived, and only those
// at the end, whose phase is not over, have not left. If that leaves a choice,
// all arrivals are skipped.
BarrierPhases FindPhases(const TraceHistory& history);

}  // namespace bench
