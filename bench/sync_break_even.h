#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bench/statistics.h"
#include "bench/sync_conditions.h"
#include "bench/sync_plan.h"

namespace bench {

// Work and what two tasks make of it: each does `work`, then they meet at a
// barrier. Efficiency 1 is half the serial time, 0.5 the serial time itself.
struct EfficiencyPoint {
  double work;        // s, of a task between two barriers, measured
  double efficiency;  // serial time of both works / (2 parallel time)
};

// The least work from which on the efficiency stays at `target` or above,
// interpolated in the logarithm of the work between the last point below and
// the next. Nothing if the last point is below; the first work if all are
// above. Requires: points in ascending order of work, at least one.
std::optional<double> LeastWork(const std::vector<EfficiencyPoint>& points,
                                double target);

// The same over repetitions: the efficiency is a median, with its interval.
struct CurvePoint {
  double work;
  double efficiency;
  Interval interval;
};

// Where the curve of the medians reaches the target, and where its upper and
// lower bounds do. Nothing in those that never do.
struct WorkSummary {
  std::optional<double> median, low, high;  // s
};
WorkSummary SummarizeWork(const std::vector<CurvePoint>& curve, double target);

// A barrier at one distance of the processors.
struct BreakEvenRow {
  std::string construct, by;
  Distance distance = Distance::kOnly;
  WorkSummary half;        // least work for an efficiency of 0.5
  WorkSummary ninety;      // ... of 0.9
  int dropped = 0;         // repetitions in which the distance changed
  int points_dropped = 0;  // of the curves of all repetitions: time stolen, or
                           // switched out, in each of several tries
  int n = 0;               // repetitions that were not dropped
  std::vector<CurvePoint> curve;
};

struct BreakEven {
  DistanceSplit split;
  double least_work, most_work;     // s, the range that was tried
  std::vector<double> round_trips;  // s, all that were measured
  std::vector<BreakEvenRow> rows;
};

// Measures all barriers of the plan for two tasks. Throws std::invalid_argument
// if there are not two processors.
BreakEven MeasureBreakEven(const SyncAxes& axes, int repetitions,
                           const std::function<void(int, int)>& show);

}  // namespace bench
