#include "bench/predict/calibration.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <string>

#include "bench/machine.h"
#include "bench/predict/figure_program.h"
#include "bench/statistics.h"
#include "macrotask/placement.h"

namespace bench::predict {
namespace {

constexpr int kRounds = 12;  // of all steps, for a prediction

const CalibrationOptions& Checked(const CalibrationOptions& options) {
  if (macrotask::NumProcessors() < 2) {
    throw std::invalid_argument(
        "to measure what waiting costs takes 2 processors, and this process "
        "may use 1: expected --machine FILE");
  }
  PrepareTrace(options.most_tasks);
  return options;
}

// The clock and what a record takes leave no ratios of less.
constexpr double kLeastTold = 50e-9;  // s

using Samples = std::vector<BlockSample>;

Samples Undisturbed(const Samples& samples, const DistanceSplit& split) {
  Samples kept;
  for (const BlockSample& sample : samples) {
    const auto disturbance = JudgeSample(sample.conditions, split);
    if (disturbance == Disturbance::kNone) kept.push_back(sample);
  }
  return kept;
}

double ModelSeconds(const MachineModel& machine, const BlockSample& sample) {
  return machine
      .BlocksOf(sample.num_lanes)[static_cast<std::size_t>(sample.block)]
      .Seconds(sample.counts.packs, sample.counts.items);
}

BlockCosts FitBlocks(const Samples& kept, int num_lanes) {
  BlockCosts costs;
  for (int b = 0; b < kNumBlocks; ++b) {
    Samples own;
    std::vector<double> ratios;
    for (const BlockSample& sample : kept) {
      const bool wanted = sample.num_lanes == num_lanes && !sample.together &&
                          sample.block == static_cast<Block>(b);
      if (!wanted) continue;
      own.push_back(sample);
      if (!(sample.seconds > kLeastTold)) continue;
      for (const double call : sample.calls) {
        ratios.push_back(call / sample.seconds);
      }
    }
    if (own.empty()) continue;
    BlockCost& cost = costs[static_cast<std::size_t>(b)];
    cost = FitBlock(MediansOfGroups(own));
    cost.spread = SpreadOf(ratios);
  }
  return costs;
}

// OCD and CCD read nothing that others write: what they take longer, they take
// because another processor computes as well.
double FitSlowdown(const MachineModel& machine, const Samples& kept,
                   int num_lanes) {
  std::vector<double> ratios;
  for (const BlockSample& sample : kept) {
    const bool own_data =
        sample.block == Block::kOcd || sample.block == Block::kCcd;
    if (!sample.together || !own_data || sample.num_lanes != num_lanes) {
      continue;
    }
    ratios.push_back(sample.seconds / ModelSeconds(machine, sample));
  }
  return ratios.empty() ? 1 : std::max(1.0, Median(ratios));
}

// What a line from another processor costs in that block.
double FitLine(const MachineModel& machine, const Samples& kept, Block block,
               const DistanceSplit& split, Distance distance) {
  std::vector<double> seconds;
  for (const BlockSample& sample : kept) {
    const bool has_lines = sample.block == block && sample.counts.lines > 0;
    if (!has_lines || split.Of(sample.conditions.before.round_trip) != distance)
      continue;
    seconds.push_back(
        (sample.seconds - machine.SlowdownOn(2, sample.num_lanes) *
                              ModelSeconds(machine, sample)) /
        sample.counts.lines);
  }
  return seconds.empty() ? 0 : std::max(0.0, Median(seconds));
}

}  // namespace

Calibration::Calibration(const CalibrationOptions& options)
    : options_(Checked(options)),
      blocks_(options.lanes),
      waits_(options.hold_time) {}

void Calibration::Step() {
  if (next_ < blocks_.num_runs()) {
    blocks_.Sample(next_);
  } else {
    waits_.Sample(next_ - blocks_.num_runs());
  }
  next_ = (next_ + 1) % num_steps();
}

DistanceSplit Calibration::Split(const std::vector<double>& others) const {
  std::vector<double> trips = others;
  for (const auto& own : {blocks_.round_trips(), waits_.round_trips()}) {
    trips.insert(trips.end(), own.begin(), own.end());
  }
  return SplitDistances(trips);
}

MachineModel Calibration::Fit(const DistanceSplit& split) const {
  MachineModel machine;
  const Machine self = DescribeMachine();
  machine.name = self.cpu;
  machine.source =
      fmt::format("measured by macrotask {} ({}), {}, {} {}", self.version,
                  self.git_hash, self.kernel, self.compiler, self.flags);
  machine.processors = self.processors;
  const Samples kept = Undisturbed(blocks_.samples(), split);
  for (const int lanes : options_.lanes) {
    machine.lanes[lanes] = FitBlocks(kept, lanes);
    machine.slowdowns.push_back({.from_processors = 2,
                                 .lanes = lanes,
                                 .factor = FitSlowdown(machine, kept, lanes),
                                 .why = "they compute at the same time"});
  }

  const std::vector<double> trips = waits_.round_trips();
  const std::vector<SyncRow> rows = MakeRows(waits_.series(), split);
  for (const Distance distance :
       {Distance::kOnly, Distance::kNear, Distance::kFar}) {
    std::vector<double> own;
    for (const double trip : trips) {
      if (split.Of(trip) == distance) own.push_back(trip);
    }
    if (own.empty()) continue;
    machine.conditions.push_back(
        {.name = std::string(Name(distance)),
         .share = static_cast<double>(own.size()) /
                  static_cast<double>(trips.size()),
         .point_line = FitLine(machine, kept, Block::kCs, split, distance),
         .tip_line = FitLine(machine, kept, Block::kRma, split, distance),
         .waits = FitWaits(rows, distance, Median(own) / 2, machine.processors,
                           options_.hold_time)});
  }
  return machine;
}

MachineModel Calibrate(const CalibrationOptions& options,
                       const std::function<void(int, int)>& show) {
  Calibration calibration(options);
  const int num_steps = kRounds * calibration.num_steps();
  for (int step = 0; step < num_steps; ++step) {
    show(step, num_steps);
    calibration.Step();
  }
  return calibration.Fit(calibration.Split());
}

}  // namespace bench::predict
