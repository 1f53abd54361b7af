#pragma once

#include <vector>

#include "bench/reproduce.h"

// From the times of a reproduction to the paper's T, S_p, S_a.

namespace bench {

// T of each repetition (s): the time for an error of 1e-6 m.
std::vector<double> T(const TableRow& row);
double MedianT(const TableRow& row);

// A gain: the median of the ratios of times that were measured next to each
// other. The machine changes its speed from second to second, so that the ratio
// of the two medians may lie outside of all that was seen side by side.
struct Gain {
  double value;
  Interval interval;
};
Gain GainOf(const std::vector<double>& before,
            const std::vector<double>& after);

// S_p of one row.
Gain SpeedupOf(const TableRow& serial, const TableRow& row);

// S_a from the numbers of steps, a pure number, and from the clock.
double StepSpeedup(const Reproduction& reproduction, int block_size);
double ClockSpeedup(const LaneTables& tables, int block_size);

}  // namespace bench
