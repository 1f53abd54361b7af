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

// Of one round. The blocks vary less and are cheaper.
constexpr int kBlockRepetitions = 5;
constexpr int kWaitRepetitions = 3;
constexpr int kRounds = 4;

const CalibrationOptions& Checked(const CalibrationOptions& options) {
  if (macrotask::NumProcessors() < 2) {
    throw std::invalid_argument(
        "to measure what waiting costs takes 2 processors, and this process "
        "may use 1: expected --machine FILE");
  }
  PrepareTrace();
  return options;
}

double ModelSeconds(const MachineModel& machine, const BlockSample& sample) {
  return machine.BlocksOf(sample.num_lanes)[static_cast<std::size_t>(
      sample.block)]
      .Seconds(sample.counts.packs, sample.counts.items);
}

}  // namespace

Calibration::Calibration(const CalibrationOptions& options)
    : options_(Checked(options)),
      blocks_(options.lanes),
      waits_(options.hold_time) {}

void Calibration::Round() {
  for (int r = 0; r < kBlockRepetitions; ++r) blocks_.Round();
  waits_.Round(kWaitRepetitions);
}

DistanceSplit Calibration::Split(const std::vector<double>& others) const {
  std::vector<double> trips = others;
  for (const auto& own : {blocks_.round_trips(), waits_.round_trips()}) {
    trips.insert(trips.end(), own.begin(), own.end());
  }
  return SplitDistances(trips);
}

// OCD and CCD read nothing that others write: what they take longer, they take
// because another processor computes as well.
double Calibration::FitSlowdown(const MachineModel& machine) const {
  std::vector<double> ratios;
  for (const BlockSample& sample : blocks_.samples()) {
    const bool own_data =
        sample.block == Block::kOcd || sample.block == Block::kCcd;
    if (!sample.together || !own_data) continue;
    ratios.push_back(sample.seconds / ModelSeconds(machine, sample));
  }
  return ratios.empty() ? 1 : std::max(1.0, Median(ratios));
}

double Calibration::FitLine(const MachineModel& machine,
                            const DistanceSplit& split, Distance distance,
                            double guess) const {
  const double slowdown = machine.SlowdownOn(2);
  std::vector<double> seconds;
  for (const BlockSample& sample : blocks_.samples()) {
    if (!sample.together || !(sample.counts.lines > 0)) continue;
    if (split.Of(sample.round_trip) != distance) continue;
    seconds.push_back(
        (sample.seconds - slowdown * ModelSeconds(machine, sample)) /
        sample.counts.lines);
  }
  return seconds.empty() ? guess : std::max(0.0, Median(seconds));
}

MachineModel Calibration::Fit(const DistanceSplit& split) const {
  MachineModel machine;
  const Machine self = DescribeMachine();
  machine.name = self.cpu;
  machine.source = fmt::format("measured by macrotask {} ({}), {}, {} {}",
                               self.version, self.git_hash, self.kernel,
                               self.compiler, self.flags);
  machine.processors = self.processors;
  for (const int lanes : options_.lanes) {
    BlockCosts& costs = machine.lanes[lanes];
    for (int b = 0; b < kNumBlocks; ++b) {
      std::vector<BlockSample> samples;
      for (const BlockSample& sample : blocks_.samples()) {
        if (sample.num_lanes == lanes && !sample.together &&
            sample.block == static_cast<Block>(b)) {
          samples.push_back(sample);
        }
      }
      if (samples.empty()) continue;
      BlockCost& cost = costs[static_cast<std::size_t>(b)];
      cost = FitBlock(MediansOfGroups(samples));
      const auto ratios = blocks_.ratios().find({lanes, static_cast<Block>(b)});
      if (ratios != blocks_.ratios().end()) {
        cost.spread = SpreadOf(ratios->second);
      }
    }
  }
  machine.slowdowns = {{.from_processors = 2, .factor = FitSlowdown(machine)}};

  std::vector<double> trips = waits_.round_trips();
  const std::vector<SyncRow> rows = MakeRows(waits_.series(), split);
  for (const Distance distance :
       {Distance::kOnly, Distance::kNear, Distance::kFar}) {
    std::vector<double> own;
    for (const double trip : trips) {
      if (split.Of(trip) == distance) own.push_back(trip);
    }
    if (own.empty()) continue;
    const double one_way = Median(own) / 2;
    machine.conditions.push_back(
        {.name = std::string(Name(distance)),
         .share = static_cast<double>(own.size()) /
                  static_cast<double>(trips.size()),
         .line = FitLine(machine, split, distance, one_way),
         .waits = FitWaits(rows, distance, one_way, machine.processors,
                           options_.hold_time)});
  }
  return machine;
}

MachineModel Calibrate(const CalibrationOptions& options,
                       const std::function<void(int, int)>& show) {
  Calibration calibration(options);
  for (int r = 0; r < kRounds; ++r) {
    show(r, kRounds);
    calibration.Round();
  }
  return calibration.Fit(calibration.Split());
}

}  // namespace bench::predict
