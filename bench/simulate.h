#pragma once

#include <string>

#include "dynamics/closed_chain_system.h"
#include "integrators/integration.h"

namespace bench {

enum class StartKind { kDopri5, kPlan };

struct SimulateOptions {
  std::string method = "B1PC5";
  double step = 0.01;  // s
  integrators::Figure figure = integrators::Figure::kFigure8;
  integrators::Partition partition;
  macrotask::WaitPolicy wait;
  dynamics::Lanes lanes = dynamics::Lanes::kFour;
  StartKind start = StartKind::kDopri5;
  int num_chains = 4;
  bool rotor_inertia = false;
  std::string output;  // trajectory as CSV; none if empty
  std::string trace;   // history trace of the run; none if empty
  bool breakdown = false;
  int repetitions = 200;  // of the runs that are broken down
};

// Runs one simulation of the lift, writes the trajectory if wanted, and returns
// what there is to say about it. Throws, one sentence, on bad input.
std::string Simulate(const SimulateOptions& options);

}  // namespace bench
