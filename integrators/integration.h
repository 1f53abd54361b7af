#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "integrators/block_method.h"
#include "integrators/block_run.h"
#include "integrators/integration_error.h"
#include "integrators/start.h"
#include "integrators/system.h"
#include "integrators/task_structure.h"
#include "macrotask/wait_policy.h"

namespace integrators {

struct IntegrationOptions {
  BlockMethod method = B1PC5();
  double step = 0;    // h, s
  int num_steps = 0;  // the integration goes from 0 to num_steps h
  Figure figure = Figure::kSerial;
  Partition partition = {};
  macrotask::WaitPolicy wait = {};
  bool record = false;  // keep the states at all grid points
  // Called by every task of a run, counted from 0, when its time has begun and
  // before it ends: who is who, and when, in a history trace.
  std::function<void(int task)> on_begin = {}, on_end = {};
};

// Number of steps of length `step` in `duration` (s). Throws
// std::invalid_argument, one sentence, if the step is not positive, does not
// divide the duration (to 1e-9 of a step), or makes more than a million steps.
int CountSteps(double duration, double step);

// Throws std::invalid_argument, one sentence, if the method cannot start in so
// few steps.
void CheckNumSteps(const BlockMethod& method, int num_steps);

struct IntegrationResult {
  std::vector<double> state;     // full state at the end: chains, then common
  std::int64_t evaluations = 0;  // derivative evaluations of the whole system
  double start_seconds = 0;      // computing the first k values
  double block_seconds = 0;      // from then to the end
  double seconds() const { return start_seconds + block_seconds; }
};

// The integration of one system by a block method, in parallel as one of the
// figures says. Everything is allocated here, once; it can be run again and
// again. Times are taken by task 1, from when all tasks are there until the
// last has ended; TSKSTART and TSKWAIT are not in them, as the tasks of a
// simulation are started once.
class Integration {
 public:
  // Throws std::invalid_argument, one sentence, if the partition is larger than
  // the chains or the points of a block, does not suit the figure, or there are
  // fewer steps than the method needs to start.
  // `system` must outlive it.
  template <ChainSystem S>
  Integration(const S& system, const IntegrationOptions& options)
      : Integration(std::make_unique<SystemOf<S>>(system), options) {}
  template <ChainSystem S>
  Integration(const S&& system, const IntegrationOptions& options) = delete;
  Integration(std::unique_ptr<System> system,
              const IntegrationOptions& options);
  Integration(const Integration&) = delete;
  Integration& operator=(const Integration&) = delete;

  // Integrates from the full state y0 at t = 0, starting with DOPRI5. Throws
  // IntegrationError where the system cannot be evaluated, what its user code
  // throws, or std::system_error if there cannot be so many tasks.
  IntegrationResult Run(const std::vector<double>& y0);

  // The same, starting from known values.
  IntegrationResult RunFrom(const ExactValues& values);

  // States at all grid points of the last run, (num_steps + 1) full vectors one
  // after the other, if recorded.
  const std::vector<double>& trajectory() const { return trajectory_; }
  const StateLayout& layout() const { return run_.layout; }
  const System& system() const { return *system_; }

 private:
  template <typename StartFunction>
  IntegrationResult RunTasks(StartFunction start);

  std::unique_ptr<System> system_;
  macrotask::WaitPolicy wait_;
  BlockRun run_;
  Start start_;
  std::unique_ptr<EvaluationFactory> factory_;
  Figure figure_;
  std::function<void(int)> on_begin_, on_end_;
  std::vector<std::unique_ptr<BlockTask>> tasks_;  // (p^ x m^)
  std::vector<double> trajectory_;
};

}  // namespace integrators
