#include "bench/predict/validation.h"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <memory>
#include <utility>

#include "bench/predict/measured_run.h"
#include "bench/statistics.h"
#include "bench/sync_delay.h"
#include "bench/sync_plan.h"
#include "macrotask/placement.h"

namespace bench::predict {
namespace {

using integrators::BlockMethod;
using integrators::Figure;
using integrators::Partition;
using macrotask::WaitKind;

// The values to start from and whole blocks of all methods.
constexpr int kSteps = 4 + 64;
constexpr int kRepetitions = 4;  // of a round

struct Run {
  RunCase run_case;
  std::unique_ptr<MeasuredRun> run;
  struct Sample {
    SampleConditions conditions;
    double seconds;
  };
  std::vector<Sample> samples;
};

class CaseList {
 public:
  void Add(const BlockMethod& method, Figure figure, Partition partition,
           const std::vector<WaitKind>& waits, int processors,
           const std::vector<double>& works) {
    for (const int num_lanes : {1, 4}) {
      for (const double work : works) {
        for (const WaitKind wait : waits) {
          const int pairs = 2 * kNumChains * method.block_size;
          cases_.push_back({.figure = {.method = method,
                                       .figure = figure,
                                       .partition = partition,
                                       .num_chains = kNumChains,
                                       .num_steps = kSteps},
                            .num_lanes = num_lanes,
                            .wait = wait,
                            .work = work * 1e-6 / pairs,
                            .processors = processors});
        }
      }
    }
  }

  std::vector<RunCase> Take() { return std::move(cases_); }

 private:
  static constexpr int kNumChains = 4;
  std::vector<RunCase> cases_;
};

}  // namespace

std::vector<RunCase> ValidationCases() {
  const std::vector<double> works = {0, 10, 100};  // us a block
  const std::vector<double> few_works = {0, 100};
  const std::vector<WaitKind> logical = {WaitKind::kLogical};
  CaseList list;
  for (const BlockMethod& method :
       {integrators::B1PC5(), integrators::B2PC5(), integrators::B4PC5()}) {
    const int b = method.block_size;
    list.Add(method, Figure::kSerial, {1, 1}, {WaitKind::kHold}, 1, works);
    for (const Figure figure :
         {Figure::kFigure2, Figure::kFigure3, Figure::kFigure8}) {
      list.Add(method, figure, {2, 1}, AllWaitKinds(), 2, works);
    }
    if (b > 1) {
      list.Add(method, Figure::kFigure7, {1, 2}, AllWaitKinds(), 2, works);
      list.Add(method, Figure::kFigure8, {1, 2}, AllWaitKinds(), 2, works);
    }
    // More tasks than processors.
    for (const int processors : {1, 2}) {
      list.Add(method, Figure::kFigure8, {4, 1}, logical, processors,
               few_works);
      list.Add(method, Figure::kFigure8, {4, b}, logical, processors,
               few_works);
    }
    list.Add(method, Figure::kFigure8, {4, 1},
             {WaitKind::kHold, WaitKind::kSpin, WaitKind::kBlock}, 2,
             few_works);
  }
  return list.Take();
}

namespace {

// Runs the cases in turn, and knows how near the processors were.
class Measurement {
 public:
  explicit Measurement(std::chrono::nanoseconds hold_time)
      : lift_(dynamics::PumaLift(), kSteps) {
    const double rate = MeasureDelayRate();
    for (const RunCase& run_case : ValidationCases()) {
      if (run_case.processors > macrotask::NumProcessors()) continue;
      const ProcessorsFor use(run_case.processors);
      runs_.push_back(
          {run_case,
           std::make_unique<MeasuredRun>(
               run_case, lift_,
               macrotask::WaitPolicy{run_case.wait, hold_time}, rate),
           {}});
    }
  }

  void Repeat() {
    for (Run& run : runs_) {
      SampleConditions conditions = {.before = probe_.Look(), .after = {}};
      double seconds;
      {
        const ProcessorsFor use(run.run_case.processors);
        seconds = run.run->Measure();
      }
      conditions.after = probe_.Look();
      round_trips_.push_back(conditions.before.round_trip);
      run.samples.push_back({conditions, seconds});
    }
  }

  const std::vector<Run>& runs() const { return runs_; }
  const std::vector<double>& round_trips() const { return round_trips_; }

 private:
  LiftCase lift_;
  ConditionsProbe probe_;
  std::vector<Run> runs_;
  std::vector<double> round_trips_;
};

// Rows of a run, one for each condition in which it was measured often enough.
void AddRows(const Run& run, const DistanceSplit& split, Predictor* predictor,
             Validation* validation) {
  constexpr std::size_t kLeast = 10;
  const bool alone = run.run_case.processors == 1;
  std::vector<Run::Sample> kept;
  for (const Run::Sample& sample : run.samples) {
    const auto disturbance = JudgeSample(sample.conditions, split);
    if (disturbance == Disturbance::kNone) kept.push_back(sample);
  }
  validation->disturbed += static_cast<int>(run.samples.size() - kept.size());
  for (const Condition& condition : predictor->machine().conditions) {
    std::vector<double> seconds;
    for (const Run::Sample& sample : kept) {
      const double trip = sample.conditions.before.round_trip;
      if (alone || Name(split.Of(trip)) == condition.name) {
        seconds.push_back(sample.seconds);
      }
    }
    if (seconds.size() < kLeast) continue;
    validation->rows.push_back(
        {.run_case = run.run_case,
         .condition = alone ? "" : condition.name,
         .measured = Median(seconds),
         .n = static_cast<int>(seconds.size()),
         .predicted = predictor->PredictIn(condition, run.run_case).T()});
    if (alone) break;
  }
}

}  // namespace

Validation Validate(const CalibrationOptions& options, int rounds,
                    const std::function<void(int, int)>& show) {
  Calibration calibration(options);
  Measurement measurement(options.hold_time);
  for (int round = 0; round < rounds; ++round) {
    show(round, rounds);
    calibration.Round();
    for (int r = 0; r < kRepetitions; ++r) measurement.Repeat();
  }
  const DistanceSplit split = calibration.Split(measurement.round_trips());
  Validation validation;
  validation.machine = calibration.Fit(split);
  Predictor predictor(validation.machine, {.replications = 10});
  for (const Run& run : measurement.runs()) {
    AddRows(run, split, &predictor, &validation);
  }
  return validation;
}

}  // namespace bench::predict
