#pragma once

#include <vector>

#include "dynamics/closed_chain_system.h"
#include "dynamics/lift.h"
#include "integrators/integration.h"

namespace bench {

// The lift of a load, planned on a grid of `num_steps` steps: the input of one
// simulation, whatever method and tasks it runs with.
class LiftCase {
 public:
  LiftCase(dynamics::Lift lift, int num_steps);
  LiftCase(const LiftCase&) = delete;  // systems refer to its torques
  LiftCase& operator=(const LiftCase&) = delete;

  const dynamics::Lift& lift() const { return lift_; }
  const dynamics::TorqueTable& torques() const { return torques_; }
  int num_steps() const { return plan_.num_times() - 1; }
  double step() const { return plan_.step; }

  // State at t = 0, full vector: chains, then reference member.
  std::vector<double> InitialState() const;
  // The planned values on the grid, for integrators::Integration::RunFrom.
  integrators::ExactValues Planned() const;

  // Reference member of a full state vector.
  dynamics::MemberState<double> Member(const std::vector<double>& state) const;
  // Distance of the reference member from its planned end (m): the paper's
  // error.
  double Error(const std::vector<double>& state) const;

 private:
  void CopyColumn(int n, double* y, double* f) const;

  dynamics::Lift lift_;
  dynamics::Plan plan_;
  dynamics::TorqueTable torques_;
};

}  // namespace bench
