#pragma once

#include <vector>

#include "bench/lift_case.h"
#include "dynamics/closed_chain_system.h"

namespace bench {

// The blocks of a derivative evaluation, all chains at one point in the middle
// of the lift.
class OnePoint {
 public:
  // `lift` must outlive it.
  OnePoint(const LiftCase& lift, dynamics::Lanes lanes);
  OnePoint(const OnePoint&) = delete;
  OnePoint& operator=(const OnePoint&) = delete;

  void Ocd();
  void Rma();
  void Ccd();
  void Evaluate() {
    Ocd();
    Rma();
    Ccd();
  }

 private:
  dynamics::ClosedChainSystem system_;
  dynamics::TipExchange exchange_;
  dynamics::Evaluator evaluator_;
  std::vector<double> state_, rate_;
  std::vector<const double*> chain_states_;
  std::vector<double*> chain_rates_;
  const double* common_state_;
  double* common_rate_;
  double a_r_[6];
  double time_;
  int failure_;
};

}  // namespace bench
