#pragma once

#include <string>
#include <vector>

#include "bench/lift_case.h"
#include "macrotask/wait_policy.h"

namespace bench {

// What one call of something costs, by its samples.
struct Cost {
  std::string name;             // bench row
  std::string with;             // lanes, tasks, policy
  std::vector<double> seconds;  // one call, by repetition
};

// The blocks of a derivative evaluation of all chains at one point, on one
// processor, at both lane widths: "OCD", "RMA", "CCD" and "evaluation", which
// is all three; and with two processors "evaluation, two at once", by two tasks
// that do not wait for each other. Repetitions interleaved.
std::vector<Cost> MeasureBlocks(const LiftCase& lift, int repetitions);

// The synchronization constructs, with two tasks when there are two processors:
// "BARSYNC", "EVPOST to EVWAIT", "LOCKON + LOCKOFF" (one task), "TSKSTART +
// TSKWAIT".
std::vector<Cost> MeasureSynchronization(macrotask::WaitPolicy wait,
                                         int repetitions);

}  // namespace bench
