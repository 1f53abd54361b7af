#include "bench/predict/prediction.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <utility>

namespace bench::predict {
namespace {

using macrotask::WaitKind;

std::string KeyOf(const FigureCase& figure_case) {
  return fmt::format("{} {} {} {} {} {}", figure_case.method.name(),
                     integrators::Name(figure_case.figure),
                     figure_case.partition.chain_tasks,
                     figure_case.partition.integration_tasks,
                     figure_case.num_chains, figure_case.num_steps);
}

void Add(const SimulationResult& result, double weight, TaskTimes* mean) {
  weight /= static_cast<double>(result.tasks.size());
  for (const TaskTimes& task : result.tasks) {
    mean->compute += weight * task.compute;
    mean->imbalance += weight * task.imbalance;
    mean->sync += weight * task.sync;
    mean->queue += weight * task.queue;
    mean->absent += weight * task.absent;
  }
}

// Costs that never vary, but are as long as those that do on average.
BlockCosts MeansOf(BlockCosts blocks) {
  for (BlockCost& cost : blocks) {
    const double mean = MeanOf(cost.spread);
    cost = {cost.call * mean, cost.pack * mean, cost.item * mean, {}};
  }
  return blocks;
}

std::array<Spread, kNumBlocks> SpreadsOf(const BlockCosts& blocks) {
  std::array<Spread, kNumBlocks> spreads;
  for (std::size_t b = 0; b < spreads.size(); ++b) {
    spreads[b] = blocks[b].spread;
  }
  return spreads;
}

}  // namespace

Interval RangeOf(const std::vector<double>& values) {
  return {Percentile(values, 0.025), Percentile(values, 0.975)};
}

WaitKind WaitFor(WaitKind kind, int num_tasks, int processors) {
  if (kind != WaitKind::kAuto) return kind;
  return num_tasks > processors ? WaitKind::kLogical : WaitKind::kHold;
}

Limits CalcLimits(const Program& program, int processors,
                  TaskPlacement placement) {
  SimulationOptions options;
  options.placement = placement;
  options.processors = program.num_tasks();
  Limits limits;
  limits.critical_path = Simulate(program, options).seconds;
  options.processors = processors;
  limits.free_sync = Simulate(program, options).seconds;
  limits.work_bound = Work(program) / processors;
  return limits;
}

Predictor::Predictor(MachineModel machine, PredictorOptions options)
    : machine_(std::move(machine)), options_(options) {}

const Condition& Predictor::ConditionOf(int replication) const {
  const double place = (replication + 0.5) / options_.replications;
  double share = 0;
  for (const Condition& condition : machine_.conditions) {
    share += condition.share;
    if (place < share) return condition;
  }
  return machine_.conditions.back();
}

const Program& Predictor::StructureOf(const FigureCase& figure_case) {
  const std::string key = KeyOf(figure_case);
  const auto known = structures_.find(key);
  if (known != structures_.end()) return known->second;
  return structures_.emplace(key, ReadFigure(figure_case)).first->second;
}

Prediction Predictor::Replicate(
    const RunCase& run_case, const std::vector<const Condition*>& conditions) {
  Program program = StructureOf(run_case.figure);
  const BlockCosts& blocks = machine_.BlocksOf(run_case.num_lanes);
  const int used = std::min(run_case.processors, program.num_tasks());
  RunCosts costs = {
      .num_lanes = run_case.num_lanes,
      .work = run_case.work *
              MeanOf(blocks[static_cast<std::size_t>(Block::kOther)].spread),
      .num_processors = run_case.processors};
  SetCosts(run_case.figure, options_.sizes, MeansOf(blocks), costs, &program);
  Prediction prediction;
  prediction.limits =
      CalcLimits(program, run_case.processors, TaskPlacement::kPinned);

  costs.work = run_case.work;
  costs.slowdown = machine_.SlowdownOn(used, run_case.num_lanes);
  SimulationOptions options = {.processors = run_case.processors,
                               .spreads = SpreadsOf(blocks)};
  const WaitKind wait =
      WaitFor(run_case.wait, program.num_tasks(), run_case.processors);
  const double weight = 1.0 / static_cast<double>(conditions.size());
  const Condition* set = nullptr;
  for (std::size_t r = 0; r < conditions.size(); ++r) {
    if (conditions[r] != set) {
      set = conditions[r];
      costs.point_line = set->point_line;
      costs.tip_line = set->tip_line;
      SetCosts(run_case.figure, options_.sizes, blocks, costs, &program);
      // A task alone never waits.
      if (program.num_tasks() > 1) options.wait = machine_.WaitOf(*set, wait);
    }
    options.seed = options_.seed + r;
    const SimulationResult result = Simulate(program, options);
    prediction.seconds.push_back(result.seconds);
    Add(result, weight, &prediction.where);
  }
  return prediction;
}

Prediction Predictor::Predict(const RunCase& run_case) {
  std::vector<const Condition*> conditions;
  for (int r = 0; r < options_.replications; ++r) {
    conditions.push_back(&ConditionOf(r));
  }
  return Replicate(run_case, conditions);
}

Prediction Predictor::PredictIn(const Condition& condition,
                                const RunCase& run_case) {
  return Replicate(
      run_case,
      std::vector<const Condition*>(
          static_cast<std::size_t>(options_.replications), &condition));
}

Prediction Predictor::PredictProgram(const Program& program, WaitKind wait,
                                     int processors, TaskPlacement placement) {
  Prediction prediction;
  prediction.limits = CalcLimits(program, processors, placement);
  SimulationOptions options = {.processors = processors,
                               .placement = placement};
  for (int r = 0; r < options_.replications; ++r) {
    const Condition& condition = ConditionOf(r);
    options.wait = machine_.WaitOf(
        condition, WaitFor(wait, program.num_tasks(), processors));
    const SimulationResult result = Simulate(program, options);
    prediction.seconds.push_back(result.seconds);
    Add(result, 1.0 / options_.replications, &prediction.where);
  }
  return prediction;
}

}  // namespace bench::predict
