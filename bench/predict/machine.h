#pragma once

#include <array>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "bench/predict/program.h"
#include "macrotask/wait_policy.h"

// A machine as the prediction sees it: what computing costs, what waiting
// costs, and how many processors there are. Measured (calibrate.h) or read from
// a file (machine_file.h).

namespace bench::predict {

// How a cost varies from call to call: quantiles of its ratio to the median, at
// equal distances from 0 to 1, ascending. Empty: it does not.
using Spread = std::vector<double>;

// The mean ratio; 1 of an empty one.
double MeanOf(const Spread& spread);

// What one call of a block of the computation costs: call + pack packs + item
// items (s). What packs and items are, see CountsOf() in figure_costs.h.
struct BlockCost {
  double call = 0;
  double pack = 0;
  double item = 0;
  Spread spread = {};

  double Seconds(double packs, double items) const {
    return call + pack * packs + item * items;
  }
  friend bool operator==(const BlockCost&, const BlockCost&) = default;
};

// From the last arrival at a barrier to the moment at which all tasks, with a
// processor each, go on (s).
struct BarrierCost {
  double two = 0;      // for 2 tasks that count on one line
  double further = 0;  // for each further one of them
  // For more, where the library has other algorithms than counting (see
  // macrotask/barrier_algorithm.h); none: counted, however many they are.
  std::optional<double> round = {};  // a round of dissemination
  std::optional<double> level = {};  // up and down a level of the tree

  double Seconds(int num_tasks) const;
  friend bool operator==(const BarrierCost&, const BarrierCost&) = default;
};

inline constexpr double kNever = std::numeric_limits<double>::infinity();

// What one way to wait costs (s).
struct WaitCost {
  BarrierCost barrier;
  double event = 0;  // from a post to the return of a task that waits
  double post = 0;   // what a post or a clear costs its caller
  double lock = 0;   // from a release to the return of the next one
  double start = 0;  // from TSKSTART to the first instruction
  double sleeps_after = kNever;  // a wait that has lasted so long sleeps
  double wake = 0;   // from the release to the return of one that sleeps
  double waker = 0;  // what it costs whoever lets sleepers go
  // Tasks that share a processor:
  double turn = 0;         // one gives its turn to the next
  double shared_wake = 0;  // from the release of a task to when it is ready

  friend bool operator==(const WaitCost&, const WaitCost&) = default;
};

// The state of a machine that changes while one watches: its processors are
// near each other or far apart.
struct Condition {
  std::string name;  // "near", "far"; "" if there is only one
  double share = 1;  // of the time
  // s, to fetch a cache line that another processor wrote: of the derivatives
  // at another point, in CS, and of the tip of a chain, in RMA.
  double point_line = 0, tip_line = 0;
  std::map<macrotask::WaitKind, WaitCost> waits;

  friend bool operator==(const Condition&, const Condition&) = default;
};

// Computing takes `factor` times as long on so many processors or more: they
// share something, if only the machine with other users.
struct Slowdown {
  int from_processors = 2;
  int lanes = 0;  // with this width; 0: with all
  double factor = 1;
  std::string why = {};  // what they share, for whoever reads it

  friend bool operator==(const Slowdown&, const Slowdown&) = default;
};

using BlockCosts = std::array<BlockCost, kNumBlocks>;

struct MachineModel {
  std::string name;
  std::string source;  // where the figures come from
  int processors = 1;
  std::map<int, BlockCosts> lanes;  // by how many pairs share a register
  std::vector<Condition> conditions;
  std::vector<Slowdown> slowdowns;

  double SlowdownOn(int num_processors, int num_lanes) const;
  // Throws std::invalid_argument, one sentence, if the machine has no such.
  const BlockCosts& BlocksOf(int num_lanes) const;
  int widest_lanes() const { return lanes.empty() ? 1 : lanes.rbegin()->first; }
  const WaitCost& WaitOf(const Condition& condition,
                         macrotask::WaitKind kind) const;

  friend bool operator==(const MachineModel&, const MachineModel&) = default;
};

}  // namespace bench::predict
