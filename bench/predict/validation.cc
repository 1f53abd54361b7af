#include "bench/predict/validation.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
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
constexpr int kDelayEvery = 50;  // runs

struct Run {
  RunCase run_case;
  long delay_steps;
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
      : lift_(dynamics::PumaLift(), kSteps), hold_time_(hold_time) {
    // Nominally; what a step takes is measured along with the runs.
    const double rate = MeasureDelayRate();
    for (const RunCase& run_case : ValidationCases()) {
      if (run_case.processors > macrotask::NumProcessors()) continue;
      runs_.push_back({run_case, DelaySteps(run_case.work * 1e6, rate), {}});
    }
  }

  // Calls between() before every run.
  template <typename Between>
  void Repeat(const Between& between) {
    for (Run& run : runs_) {
      between();
      SampleConditions conditions = {.before = probe_.Look(), .after = {}};
      const double seconds = Measure(run);
      conditions.after = probe_.Look();
      round_trips_.push_back(conditions.before.round_trip);
      run.samples.push_back({conditions, seconds});
    }
  }

  int num_runs() const { return static_cast<int>(runs_.size()); }

  // The runs, with the work that their steps of Delay() usually were.
  std::vector<Run> TakeRuns() {
    for (Run& run : runs_) {
      const auto tasks = static_cast<std::size_t>(std::min(
          run.run_case.processors, run.run_case.figure.partition.num_tasks()));
      run.run_case.work = static_cast<double>(run.delay_steps) *
                          Median(delay_steps_.at(tasks - 1));
    }
    return std::move(runs_);
  }

  void MeasureDelay() {
    for (int tasks = 1; tasks <= 2; ++tasks) {
      delay_steps_[static_cast<std::size_t>(tasks - 1)].push_back(
          MeasureDelayStep(tasks));
    }
  }
  const std::vector<double>& round_trips() const { return round_trips_; }

 private:
  // Made anew each time: where its memory is makes a run faster or slower.
  double Measure(const Run& run) {
    const ProcessorsFor use(run.run_case.processors);
    return MeasuredRun(run.run_case, lift_, {run.run_case.wait, hold_time_},
                       run.delay_steps)
        .Measure();
  }

  LiftCase lift_;
  std::chrono::nanoseconds hold_time_;
  ConditionsProbe probe_;
  std::vector<Run> runs_;
  std::vector<double> round_trips_;
  std::array<std::vector<double>, 2> delay_steps_;  // s, by tasks less one
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
  // So that in a round every step of the calibration has its turn.
  const int runs_a_step =
      std::max(1, measurement.num_runs() / calibration.num_steps());
  int num_runs = 0;
  for (int round = 0; round < rounds; ++round) {
    measurement.Repeat([&] {
      if (num_runs % kDelayEvery == 0) measurement.MeasureDelay();
      if (num_runs++ % runs_a_step == 0) calibration.Step();
      show(num_runs, rounds * measurement.num_runs());
    });
  }
  const DistanceSplit split = calibration.Split(measurement.round_trips());
  Validation validation;
  validation.machine = calibration.Fit(split);
  Predictor predictor(validation.machine, {.replications = 10});
  for (const Run& run : measurement.TakeRuns()) {
    AddRows(run, split, &predictor, &validation);
  }
  return validation;
}

}  // namespace bench::predict
