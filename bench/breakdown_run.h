#pragma once

#include <functional>
#include <string>
#include <vector>

#include "bench/breakdown.h"
#include "integrators/integration.h"

// The breakdown of a run that is made again and again, and its table.

namespace bench {

struct BreakdownOptions {
  integrators::Figure figure = integrators::Figure::kFigure8;
  integrators::Partition partition;
  int most_blocks = 0;  // of one run
  int repetitions = 200;
};

// One run that left a history trace.
struct TracedRun {
  double seconds = 0;
  std::vector<TaskBreakdown> tasks;
};

struct MeasuredBreakdown {
  BreakdownOptions options;
  double ticks_per_second = 1e9;
  std::vector<TracedRun> traced;         // by repetition
  std::vector<double> untraced_seconds;  // by repetition, next to the former
};

// Makes the history trace ready, before anything runs. Throws
// std::invalid_argument, one sentence, if the records of a run do not fit in
// memory, or if recording is on already.
void PrepareBreakdown(const BreakdownOptions& options);

// Runs with and without a history trace in turn, each time twice in a row, of
// which the second counts. `run` must call RecordBegin() and RecordEnd() in its
// tasks; throws what it throws.
MeasuredBreakdown MeasureBreakdown(
    const std::function<integrators::IntegrationResult()>& run,
    const BreakdownOptions& options);

// The half of the runs, at least one, whose time is in the middle: without
// those in which the machine did something else.
std::vector<TracedRun> MiddleHalf(std::vector<TracedRun> runs);

// The table: a row a task, then the share of all of them. Means over the middle
// half of the runs: these add up, as medians would not. Below it what the
// columns are, and how much the trace itself took.
std::string BreakdownText(const MeasuredBreakdown& measured);

}  // namespace bench
