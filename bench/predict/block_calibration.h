#pragma once

#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "bench/lift_case.h"
#include "bench/predict/figure_costs.h"
#include "bench/predict/machine.h"
#include "bench/sync_conditions.h"
#include "macrotask/trace_file.h"

// What the blocks of the computation cost on this machine.

namespace bench::predict {

// The median over the calls of one task in one run, and what it did.
struct BlockSample {
  int num_lanes = 4;
  Block block = Block::kOther;
  Counts counts;
  bool together = false;  // another processor computed at the same time
  SampleConditions conditions;
  double seconds = 0;
  std::vector<double> calls = {};  // each of them, in a serial run (s)
};

// Costs that grow with packs and items as the samples do: least squares of the
// relative errors, no coefficient negative. Where the samples do not tell two
// of them apart, the smaller ones of all solutions.
BlockCost FitBlock(const std::vector<BlockSample>& samples);

// The medians of samples with the same counts.
std::vector<BlockSample> MediansOfGroups(
    const std::vector<BlockSample>& samples);

// Quantiles from 0.5 % to 99.5 %: what lies outside, interrupts of the
// processor, does not belong to the block.
Spread SpreadOf(std::vector<double> ratios);

// What writing a record of the history trace takes, next to another one (s).
double MeasureRecord();

// Runs methods that nobody uses, such as B3PC5, with marks in their history
// trace, serially with 1, 2 and 4 chains, and by two tasks; and takes the blocks'
// durations from there, so that they are those of a run and not of a loop. What
// a record takes is the difference to the same run without them. Busy work, a
// step of Delay() an item, is kOther. A
// task has its processor to itself in all of them, as in what is predicted.
class BlockSampler {
 public:
  explicit BlockSampler(const std::vector<int>& lanes);
  ~BlockSampler();

  // Runs one of so many, 0 ..., once. Requires PrepareTrace() before.
  int num_runs() const { return static_cast<int>(runs_.size()) + 1; }
  void Sample(int run);

  // Without what the records themselves took.
  std::vector<BlockSample> samples() const;
  // All round trips between the processors that were seen (s).
  const std::vector<double>& round_trips() const { return round_trips_; }

 private:
  struct Run;
  void Add(const integrators::BlockMethod& method, int num_lanes,
           int num_chains, integrators::Partition partition);
  void Measure(const Run& run);
  void MeasureBusyWork();
  macrotask::Trace TraceOf(const Run& run);

  std::map<int, std::unique_ptr<LiftCase>> lifts_;  // by number of chains
  std::vector<std::unique_ptr<Run>> runs_;
  ConditionsProbe probe_;
  std::vector<int> lanes_;
  std::vector<BlockSample> samples_;
  std::vector<double> record_seconds_;  // a record, in a run
  std::vector<double> round_trips_;
};

}  // namespace bench::predict
