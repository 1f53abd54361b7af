#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bench/predict/calibration.h"
#include "bench/predict/prediction_table.h"

// The fastest way to run the lift on this machine.

namespace bench::predict {

// One way to run it, predicted, and measured if it was among the best.
struct Candidate {
  const MethodSweep* sweep = nullptr;
  RunCase run_case;
  double predicted = 0;          // s, at the steps for the target error
  std::vector<double> measured;  // s, likewise, by repetition
};

// When the paper's rule holds: the least busy work for each chain at each point
// from which on the configuration that the rule chooses is the fastest.
struct RuleTurn {
  int num_lanes = 4;
  std::string rule, best;        // configurations, without further work
  double loss = 1;               // T of the rule's over that of the best
  std::optional<double> work;    // s; 0: it holds as it is; none: not even
                                 // with the most that was tried
  double compute = 0, sync = 0;  // s, of a task of the rule's configuration
                                 // between two barriers, with that work
};

struct Tuning {
  MachineModel machine;
  std::vector<MethodSweep> sweeps;
  std::vector<Candidate> candidates;  // all, the fastest predicted first
  std::vector<Candidate> measured;    // the best three and the best serial one
  std::vector<RuleTurn> turns;        // by lanes
};

struct TuningOptions {
  std::vector<integrators::BlockMethod> methods;
  CalibrationOptions calibration;
  int repetitions = 200;
};

// The most busy work that is tried for RuleTurn.
inline constexpr double kMostWork = 1e-3;  // s

RuleTurn FindTurn(const TableOptions& options,
                  const std::vector<MethodSweep>& sweeps, Predictor* predictor);

Tuning Tune(const TuningOptions& options,
            const std::function<void(const char*, int, int)>& show);

// The measured one with the least median.
const Candidate& WinnerOf(const Tuning& tuning);

std::string TuningText(const Tuning& tuning);

// The winner as options of `macrotask simulate`, one line.
std::string SimulateOptionsText(const Candidate& candidate);

}  // namespace bench::predict
