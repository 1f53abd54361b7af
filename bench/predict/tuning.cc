#include "bench/predict/tuning.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <memory>

#include "bench/lift_case.h"
#include "bench/predict/measured_run.h"
#include "bench/sync_plan.h"
#include "macrotask/placement.h"

namespace bench::predict {
namespace {

using integrators::Partition;

constexpr int kNumChains = 4;

std::vector<Candidate> PredictAll(const Tuning& tuning, Predictor* predictor) {
  std::vector<Candidate> candidates;
  const int processors = tuning.machine.processors;
  const auto add = [&](const TableOptions& options, const MethodSweep& sweep,
                       Partition partition) {
    const RunCase run_case = CaseOf(options, sweep, partition, processors);
    const double scale = sweep.steps_at_target / WholeSteps(sweep);
    candidates.push_back({.sweep = &sweep,
                          .run_case = run_case,
                          .predicted = predictor->Predict(run_case).T() * scale,
                          .measured = {}});
  };
  for (const auto& [lanes, unused] : tuning.machine.lanes) {
    for (const MethodSweep& sweep : tuning.sweeps) {
      TableOptions options;
      options.num_lanes = lanes;
      add(options, sweep, {1, 1});
      for (const macrotask::WaitKind wait : AllWaitKinds()) {
        options.wait = wait;
        for (const Partition partition : UsefulPartitions(
                 processors, kNumChains, sweep.method.block_size)) {
          if (partition.num_tasks() > 1) add(options, sweep, partition);
        }
      }
    }
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) {
                     return a.predicted < b.predicted;
                   });
  return candidates;
}

bool IsSerial(const Candidate& candidate) {
  return candidate.run_case.figure.partition.num_tasks() == 1;
}

std::vector<Candidate> Finalists(const std::vector<Candidate>& candidates) {
  constexpr std::size_t kBest = 3;
  std::vector<Candidate> finalists(
      candidates.begin(),
      candidates.begin() +
          static_cast<std::ptrdiff_t>(std::min(kBest, candidates.size())));
  if (std::none_of(finalists.begin(), finalists.end(), &IsSerial)) {
    finalists.push_back(
        *std::find_if(candidates.begin(), candidates.end(), &IsSerial));
  }
  return finalists;
}

void Measure(int repetitions, std::chrono::nanoseconds hold_time,
             std::vector<Candidate>* finalists,
             const std::function<void(const char*, int, int)>& show) {
  std::map<int, std::unique_ptr<LiftCase>> lifts;  // by number of steps
  std::vector<std::unique_ptr<MeasuredRun>> runs;
  for (const Candidate& candidate : *finalists) {
    const RunCase& run_case = candidate.run_case;
    auto& lift = lifts[run_case.figure.num_steps];
    if (!lift) {
      lift = std::make_unique<LiftCase>(dynamics::PumaLift(),
                                        run_case.figure.num_steps);
    }
    runs.push_back(std::make_unique<MeasuredRun>(
        run_case, *lift, macrotask::WaitPolicy{run_case.wait, hold_time}, 0));
  }
  for (int r = 0; r < repetitions; ++r) {
    show("measure", r, repetitions);
    for (std::size_t i = 0; i < runs.size(); ++i) {
      const MethodSweep& sweep = *(*finalists)[i].sweep;
      (*finalists)[i].measured.push_back(
          runs[i]->Measure() * sweep.steps_at_target / WholeSteps(sweep));
    }
  }
}

// T of the rule's choice over that of the best other one.
double LossOfRule(const std::vector<PredictedRow>& rows) {
  const PredictedRow& rule = RuleOf(rows);
  double best = std::numeric_limits<double>::infinity();
  for (const PredictedRow& row : rows) {
    if (&row != &rule) best = std::min(best, row.T.value);
  }
  return rule.T.value / best;
}

}  // namespace

RuleTurn FindTurn(const TableOptions& options,
                  const std::vector<MethodSweep>& sweeps,
                  Predictor* predictor) {
  const auto rows_with = [&](double work) {
    TableOptions with_work = options;
    with_work.work = work;
    return PredictRows(with_work, sweeps, predictor);
  };
  const auto holds = [&](double work) {
    return LossOfRule(rows_with(work)) <= 1;
  };
  auto rows = rows_with(0);
  RuleTurn turn = {.num_lanes = options.num_lanes,
                   .rule = ConfigurationText(RuleOf(rows)),
                   .best = ConfigurationText(BestOf(rows)),
                   .loss = LossOfRule(rows),
                   .work = {}};
  constexpr double kLeastWork = 1e-9;
  constexpr double kStep = 2;
  double low = 0, high = kLeastWork;
  if (holds(0)) {
    turn.work = 0;
  } else {
    while (high <= kMostWork && !holds(high)) {
      low = high;
      high *= kStep;
    }
    if (high > kMostWork) return turn;
    constexpr int kBisections = 6;
    for (int i = 0; i < kBisections; ++i) {
      const double middle = (low + high) / 2;
      (holds(middle) ? high : low) = middle;
    }
    turn.work = high;
    rows = rows_with(high);
  }
  const PredictedRow& rule = RuleOf(rows);
  // Per block two barriers of chains, if there are several chain tasks, and two
  // of points, likewise.
  const integrators::BlockMethod& method = rule.method;
  const auto sweep =
      std::find_if(sweeps.begin(), sweeps.end(), [&](const MethodSweep& other) {
        return other.method.name() == method.name();
      });
  const double blocks =
      (sweep->steps_at_target - (method.num_values - 1)) / method.block_size;
  const double barriers = 2 * blocks *
                          ((rule.partition.chain_tasks > 1) +
                           (rule.partition.integration_tasks > 1));
  turn.compute = rule.T.value * rule.where.compute / barriers;
  turn.sync = rule.T.value * rule.where.sync / barriers;
  return turn;
}

Tuning Tune(const TuningOptions& options,
            const std::function<void(const char*, int, int)>& show) {
  Tuning tuning;
  tuning.sweeps = SweepMethods(
      options.methods, [] { return dynamics::PumaLift(kNumChains); }, show);
  tuning.machine = Calibrate(options.calibration, [&](int done, int all) {
    show("calibrate", done, all);
  });
  Predictor predictor(tuning.machine, {});
  show("predict", 0, 1);
  tuning.candidates = PredictAll(tuning, &predictor);
  tuning.measured = Finalists(tuning.candidates);
  Measure(options.repetitions, options.calibration.hold_time, &tuning.measured,
          show);
  Predictor few(tuning.machine, {.replications = 8});
  for (const int lanes : options.calibration.lanes) {
    show("rule", 0, 1);
    tuning.turns.push_back(FindTurn({.processors = {tuning.machine.processors},
                                     .num_chains = kNumChains,
                                     .num_lanes = lanes},
                                    tuning.sweeps, &few));
  }
  return tuning;
}

const Candidate& WinnerOf(const Tuning& tuning) {
  return *std::min_element(tuning.measured.begin(), tuning.measured.end(),
                           [](const Candidate& a, const Candidate& b) {
                             return Median(a.measured) < Median(b.measured);
                           });
}

}  // namespace bench::predict
