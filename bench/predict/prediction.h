#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "bench/predict/figure_costs.h"
#include "bench/predict/figure_program.h"
#include "bench/predict/machine.h"
#include "bench/predict/simulation.h"
#include "bench/statistics.h"
#include "macrotask/wait_policy.h"

namespace bench::predict {

// A run to predict, on so many processors.
struct RunCase {
  FigureCase figure;
  int num_lanes = 4;
  macrotask::WaitKind wait = macrotask::WaitKind::kAuto;
  double work = 0;  // s, busy work for each chain at each point in OCD
  int processors = 1;
};

// How fast it could be at best.
struct Limits {
  double critical_path = 0;  // s, processors without end, nothing costs to wait
  double work_bound = 0;     // s, all computing divided by the processors
  double free_sync = 0;      // s, these processors, nothing costs to wait
};

// Means over all tasks and replications; adds up to the run's mean time.
struct Prediction {
  std::vector<double> seconds;  // by replication
  TaskTimes where;              // s, mean of the tasks
  Limits limits;

  double T() const { return Median(seconds); }
};

// The middle 95 % of the replications.
Interval RangeOf(const std::vector<double>& values);

// The policy that kAuto stands for with so many tasks on so many processors.
macrotask::WaitKind WaitFor(macrotask::WaitKind kind, int num_tasks,
                            int processors);

struct PredictorOptions {
  int replications = 40;
  std::uint64_t seed = 1;
  SystemSizes sizes = {};
};

// Predicts runs on one machine. Replication r has the same condition of the
// machine and the same seed for every run, so that ratios of runs are of like
// with like; the conditions share the replications as they share the time.
class Predictor {
 public:
  Predictor(MachineModel machine, PredictorOptions options);

  const MachineModel& machine() const { return machine_; }
  const PredictorOptions& options() const { return options_; }

  // Throws std::invalid_argument, one sentence, if the machine lacks a cost.
  Prediction Predict(const RunCase& run_case);
  // The same, in one condition only.
  Prediction PredictIn(const Condition& condition, const RunCase& run_case);
  // Of a program with its own times.
  Prediction PredictProgram(const Program& program, macrotask::WaitKind wait,
                            int processors, TaskPlacement placement);

 private:
  const Condition& ConditionOf(int replication) const;
  const Program& StructureOf(const FigureCase& figure_case);
  Prediction Replicate(const RunCase& run_case,
                       const std::vector<const Condition*>& conditions);

  MachineModel machine_;
  PredictorOptions options_;
  std::map<std::string, Program> structures_;
};

// With no costs of waiting.
Limits CalcLimits(const Program& program, int processors,
                  TaskPlacement placement);

}  // namespace bench::predict
