#include "bench/predict/block_calibration.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cstddef>
#include <tuple>

#include "bench/breakdown.h"
#include "bench/predict/figure_program.h"
#include "bench/predict/marked_system.h"
#include "bench/predict/measured_run.h"
#include "bench/predict/step_reader.h"
#include "bench/statistics.h"
#include "bench/sync_clock.h"
#include "integrators/integration.h"
#include "macrotask/placement.h"
#include "macrotask/trace.h"

namespace bench::predict {
namespace {

using dynamics::ClosedChainSystem;
using integrators::Partition;
using MarkedSystem = SystemWith<ClosedChainSystem>;

// Methods that are good for nothing else: blocks of 1, 2, 3 and 5 points, so
// that there is more than one register of pairs and of points.
std::vector<integrators::BlockMethod> Methods() {
  std::vector<integrators::BlockMethod> methods;
  for (const auto& [points, values] :
       {std::pair{1, 4}, {2, 4}, {3, 5}, {5, 6}}) {
    methods.push_back(integrators::MakeBlockMethod(points, values));
  }
  return methods;
}

// Room for the start and for ten blocks or more of all of them.
constexpr int kSteps = 60;

void StartRecording() {
  using macrotask::TraceClass;
  macrotask::SetTraceClasses(static_cast<std::uint32_t>(TraceClass::kEvents) |
                             static_cast<std::uint32_t>(TraceClass::kUsers) |
                             macrotask::kLeanTrace);
}

std::array<std::vector<double>, kNumBlocks> SecondsByBlock(
    const std::vector<Step>& steps) {
  std::array<std::vector<double>, kNumBlocks> seconds;
  for (const Step& step : steps) {
    if (step.kind != StepKind::kCompute) continue;
    seconds[static_cast<std::size_t>(step.block)].push_back(step.seconds);
  }
  return seconds;
}

}  // namespace

double MeasureRecord() {
  constexpr int kMarks = 2000;
  StartRecording();
  RecordBegin(0);
  for (int i = 0; i < kMarks; ++i) Mark(Block::kOther);
  RecordEnd(0);
  macrotask::SetTraceClasses(0);
  const macrotask::Trace trace = macrotask::TakeTrace();
  const RunRecords run = RecordsOfLastRun(trace, 1);
  std::vector<double> seconds;
  for (std::size_t i = 1; i < run[0].size(); ++i) {
    seconds.push_back(
        static_cast<double>(run[0][i].clock - run[0][i - 1].clock) /
        trace.ticks_per_second);
  }
  return Median(seconds);
}

struct BlockSampler::Run {
  const LiftCase& lift;
  FigureCase figure_case;
  int num_lanes;

  int processors() const { return figure_case.partition.num_tasks(); }
};

BlockSampler::BlockSampler(const std::vector<int>& lanes) : lanes_(lanes) {
  for (const int num_lanes : lanes) {
    for (const integrators::BlockMethod& method : Methods()) {
      for (const int num_chains : {1, 2, 4}) {
        Add(method, num_lanes, num_chains, {1, 1});
      }
      if (macrotask::NumProcessors() < 2) continue;
      constexpr int kNumChains = 4;
      Add(method, num_lanes, kNumChains, {2, 1});
      if (method.block_size > 1) Add(method, num_lanes, kNumChains, {1, 2});
    }
  }
}

BlockSampler::~BlockSampler() = default;

void BlockSampler::Add(const integrators::BlockMethod& method, int num_lanes,
                       int num_chains, Partition partition) {
  auto& lift = lifts_[num_chains];
  if (!lift) {
    lift = std::make_unique<LiftCase>(dynamics::PumaLift(num_chains), kSteps);
  }
  runs_.push_back(
      std::make_unique<Run>(*lift,
                            FigureCase{.method = method,
                                       .figure = integrators::Figure::kFigure8,
                                       .partition = partition,
                                       .num_chains = num_chains,
                                       .num_steps = kSteps},
                            num_lanes));
}

void BlockSampler::Measure(const Run& run) {
  SampleConditions conditions = {.before = probe_.Look(), .after = {}};
  const macrotask::Trace trace = TraceOf(run);
  conditions.after = probe_.Look();
  round_trips_.push_back(conditions.before.round_trip);
  const RunRecords records =
      RecordsOfLastRun(trace, run.figure_case.partition.num_tasks());
  StepReader reader(trace.ticks_per_second, 0, {});
  for (std::size_t t = 0; t < records.size(); ++t) {
    const auto seconds =
        SecondsByBlock(NameBlocks(reader.Read(records[t]), t == 0));
    for (int b = 0; b < kNumBlocks; ++b) {
      const auto& own = seconds[static_cast<std::size_t>(b)];
      const auto block = static_cast<Block>(b);
      if (own.empty() || block == Block::kOther) continue;
      BlockSample sample = {
          .num_lanes = run.num_lanes,
          .block = block,
          .counts = CountsOf(block, run.figure_case, {}, run.num_lanes,
                             static_cast<int>(t), run.processors()),
          .together = run.processors() > 1,
          .conditions = conditions,
          .seconds = Median(own)};
      if (records.size() == 1) sample.calls = own;
      samples_.push_back(std::move(sample));
    }
  }
}

// The system and the integration are made anew each time: where their memory is
// makes a run faster or slower.
macrotask::Trace BlockSampler::TraceOf(const Run& run) {
  const ClosedChainSystem system(run.lift.lift().model, run.lift.torques(),
                                 static_cast<dynamics::Lanes>(run.num_lanes));
  const MarkedSystem marked(system, {.marks = true});
  integrators::Integration integration(marked,
                                       {.method = run.figure_case.method,
                                        .step = run.lift.step(),
                                        .num_steps = run.lift.num_steps(),
                                        .figure = run.figure_case.figure,
                                        .partition = run.figure_case.partition,
                                        .wait = macrotask::WaitPolicy::Hold(),
                                        .on_begin = &RecordBegin,
                                        .on_end = &RecordEnd});
  const auto run_once = [&] {
    return integration.RunFrom(run.lift.Planned()).seconds();
  };
  WarmUp(run_once);
  const double untraced = run_once();
  StartRecording();
  const double traced = run_once();
  macrotask::SetTraceClasses(0);
  macrotask::Trace trace = macrotask::TakeTrace();
  if (run.processors() == 1) {
    const RunRecords records = RecordsOfLastRun(trace, 1);
    record_seconds_.push_back((traced - untraced) /
                              static_cast<double>(records[0].size()));
  }
  return trace;
}

void BlockSampler::Sample(int run) {
  const auto index = static_cast<std::size_t>(run);
  if (index == runs_.size()) return MeasureBusyWork();
  Measure(*runs_[index]);
}

// Fixed work again and again: how much longer it sometimes takes.
void BlockSampler::MeasureBusyWork() {
  constexpr long kSteps = 10'000;
  constexpr int kTimes = 200;
  MeetBoth();
  std::vector<double> calls;
  for (int i = 0; i < kTimes; ++i) {
    const std::uint64_t start = Ticks();
    Delay(kSteps);
    calls.push_back(SecondsBetween(start, Ticks()));
  }
  for (const int num_lanes : lanes_) {
    BlockSample sample;
    sample.num_lanes = num_lanes;
    sample.block = Block::kOther;
    sample.counts.items = kSteps;
    sample.seconds = Median(calls);
    sample.calls = calls;
    samples_.push_back(std::move(sample));
  }
}

std::vector<BlockSample> BlockSampler::samples() const {
  const double record =
      record_seconds_.empty() ? 0 : std::max(0.0, Median(record_seconds_));
  std::vector<BlockSample> samples = samples_;
  for (BlockSample& sample : samples) {
    if (sample.block == Block::kOther) continue;
    sample.seconds = std::max(0.0, sample.seconds - record);
    for (double& call : sample.calls) call = std::max(0.0, call - record);
  }
  return samples;
}

std::vector<BlockSample> MediansOfGroups(
    const std::vector<BlockSample>& samples) {
  using Key = std::tuple<double, double, double>;
  std::map<Key, std::vector<double>> groups;
  for (const BlockSample& sample : samples) {
    const Counts& counts = sample.counts;
    groups[{counts.packs, counts.items, counts.lines}].push_back(
        sample.seconds);
  }
  std::vector<BlockSample> medians;
  for (const auto& [key, seconds] : groups) {
    BlockSample sample = samples.front();
    sample.counts = {std::get<0>(key), std::get<1>(key), std::get<2>(key)};
    sample.seconds = Median(seconds);
    medians.push_back(sample);
  }
  return medians;
}

BlockCost FitBlock(const std::vector<BlockSample>& samples) {
  std::array<bool, 3> used = {true, true, true};
  Eigen::Vector3d cost = Eigen::Vector3d::Zero();
  for (;;) {
    Eigen::MatrixXd A(static_cast<long>(samples.size()), 3);
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const BlockSample& sample = samples[i];
      const double weight = 1 / std::max(sample.seconds, 1e-9);
      const std::array<double, 3> row = {1, sample.counts.packs,
                                         sample.counts.items};
      for (std::size_t j = 0; j < 3; ++j) {
        A(static_cast<long>(i), static_cast<long>(j)) =
            used[j] ? row[j] * weight : 0;
      }
    }
    Eigen::VectorXd ones = Eigen::VectorXd::Ones(A.rows());
    for (std::size_t i = 0; i < samples.size(); ++i) {
      if (!(samples[i].seconds > 1e-9)) ones[static_cast<long>(i)] = 0;
    }
    cost = A.completeOrthogonalDecomposition().solve(ones);
    Eigen::Index least;
    if (cost.minCoeff(&least) >= 0) break;
    used[static_cast<std::size_t>(least)] = false;
  }
  return {.call = cost[0], .pack = cost[1], .item = cost[2]};
}

Spread SpreadOf(std::vector<double> ratios) {
  constexpr int kIntervals = 40;
  constexpr double kLeftOut = 0.005;
  if (ratios.size() < kIntervals) return {};
  Spread spread;
  std::sort(ratios.begin(), ratios.end());
  for (int i = 0; i <= kIntervals; ++i) {
    const double u = kLeftOut + (1 - 2 * kLeftOut) * i / kIntervals;
    const auto place = static_cast<std::size_t>(
        u * static_cast<double>(ratios.size() - 1) + 0.5);
    spread.push_back(ratios[place]);
  }
  return spread;
}

}  // namespace bench::predict
