#pragma once

#include <string>
#include <vector>

#include "dynamics/evaluator.h"
#include "dynamics/model.h"
#include "dynamics/reference_member.h"
#include "dynamics/torques.h"

namespace dynamics {

// How many (chain, point) pairs are computed with at once: the third dimension
// of parallelism. kOne is plain double arithmetic.
enum class Lanes { kOne = 1, kFour = 4 };

// m chains that hold one reference member, evaluated chain by chain: what an
// integrator needs to run Figures 1, 2, 3, 7 and 8. Constant; shared by tasks.
class ClosedChainSystem {
 public:
  // `torques` must outlive the system. Throws as CheckModel and
  // TorqueSource::CheckFits do.
  ClosedChainSystem(SystemModel model, const TorqueSource& torques,
                    Lanes lanes);

  const SystemModel& model() const { return model_; }
  const TorqueSource& torques() const { return torques_; }
  Lanes lanes() const { return lanes_; }

  int num_chains() const { return model_.num_chains(); }
  // Length of the state vector of chain k, and of the reference member.
  int chain_size(int k) const { return 2 * model_.chains[k].arm.num_joints(); }
  int common_size() const { return kMemberStateSize; }
  // Length of what RMA hands to CCD: a_r, [omega'; v'].
  int coupling_size() const { return 6; }

  // Slots through which tasks hand Lambda_k and Lambda_k x_k,open'' to RMA, at
  // `num_points` points.
  TipExchange MakeExchange(int num_points) const;

  // One task's share of every evaluation: `num_chains` chains at `num_points`
  // points, counted from the given ones. All tasks that evaluate together use
  // one exchange. All memory is allocated here.
  Evaluator MakeEvaluator(int first_chain, int num_chains, int first_point,
                          int num_points, TipExchange* exchange) const;

  // What a failure code (see Evaluator::Rma) means, as part of a sentence.
  std::string DescribeFailure(int code) const;

 private:
  SystemModel model_;
  const TorqueSource& torques_;
  Lanes lanes_;
};

// All accelerations and tip forces of the system in one state.
struct ClosedChainAccelerations {
  std::vector<Eigen::VectorXd> qdd;  // (m)(N_k)
  std::vector<Eigen::VectorXd> tau;  // (m)(N_k)  the torques that were used
  std::vector<Vector6<double>> f;    // (m)(6)    tip forces, see TipForce
  Vector6<double> a_r;               // (6)       [omega'; v'] at P
};

// The derivative computation of Figure 1 at one point, for users who are not
// integrators. chain_states[k] = [q; q']. Throws std::runtime_error, one
// sentence with the chain and the time, where Lambda_k^-1 is not invertible.
ClosedChainAccelerations CalcClosedChainAccelerations(
    const ClosedChainSystem& system, double t,
    const std::vector<Eigen::VectorXd>& chain_states,
    const MemberState<double>& member);

}  // namespace dynamics
