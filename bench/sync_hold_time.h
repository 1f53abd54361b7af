#pragma once

#include <functional>
#include <string>
#include <vector>

#include "bench/statistics.h"

// macrotask sync --calibrate: how long a `hold` wait should spin here.

namespace bench {

// Seconds of one hand-over from task to task, in turn.
struct HandOverSamples {
  std::vector<double> asleep;    // to a task that has gone to sleep
  std::vector<double> spinning;  // to one that spins
};

// Spinning for as long as sleeping costs never costs more than twice what the
// best choice for that wait would have cost, however long it turns out to be;
// spinning for twice as long also forgives a sleep that takes longer than most.
struct HoldTime {
  Summary cost;        // s, what sleep and wake-up add to a hand-over
  double recommended;  // s, twice the median cost, in whole microseconds
  int dropped;         // pairs in which sleeping was not the slower one
};

// Requires: both of the same length, at least one.
HoldTime CalcHoldTime(const HandOverSamples& samples);

// Throws std::invalid_argument if there are not two processors.
HandOverSamples MeasureHandOvers(int repetitions,
                                 const std::function<void(int, int)>& show);

// What the command prints.
std::string HoldTimeText(const HoldTime& hold_time);

}  // namespace bench
