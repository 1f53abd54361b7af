#include "dynamics/closed_chain_system.h"

#include <exception>
#include <span>
#include <stdexcept>
#include <utility>

namespace dynamics {

ClosedChainSystem::ClosedChainSystem(SystemModel model,
                                     const TorqueSource& torques, Lanes lanes)
    : model_(std::move(model)), torques_(torques), lanes_(lanes) {
  CheckModel(model_);
  torques_.CheckFits(model_);
}

TipExchange ClosedChainSystem::MakeExchange(int num_points) const {
  return TipExchange(num_points, num_chains());
}

Evaluator ClosedChainSystem::MakeEvaluator(int first_chain, int num_chains,
                                           int first_point, int num_points,
                                           TipExchange* exchange) const {
  return MakeEvaluatorOf(*this, first_chain, num_chains, first_point,
                         num_points, exchange);
}

std::string ClosedChainSystem::DescribeFailure(int code) const {
  if (code < 0 && -code <= num_chains()) {
    return "the acceleration of chain " + std::to_string(-code - 1) +
           " is not finite (its torques or its state are not)";
  }
  if (code < 0) return "the acceleration of the reference member is not finite";
  const int n = model_.chains[code - 1].arm.num_joints();
  const std::string chain = "chain " + std::to_string(code - 1);
  if (n < 6) {
    return chain + " has " + std::to_string(n) +
           " joints: it cannot hold the reference member in all six directions "
           "(Lambda^-1 is not invertible)";
  }
  return chain + " is at a singularity (Lambda^-1 is not invertible)";
}

ClosedChainAccelerations CalcClosedChainAccelerations(
    const ClosedChainSystem& system, double t,
    const std::vector<Eigen::VectorXd>& chain_states,
    const MemberState<double>& member) {
  const int m = system.num_chains();
  TipExchange exchange = system.MakeExchange(1);
  Evaluator evaluator = system.MakeEvaluator(0, m, 0, 1, &exchange);
  std::vector<const double*> states;
  std::vector<Eigen::VectorXd> rates;
  std::vector<double*> derivatives;
  for (int k = 0; k < m; ++k) {
    states.push_back(chain_states[k].data());
    rates.emplace_back(system.chain_size(k));
  }
  for (Eigen::VectorXd& rate : rates) derivatives.push_back(rate.data());
  double y[kMemberStateSize], yd[kMemberStateSize];
  PackMember(member, y);
  const double* common_state = y;
  double* common_derivative = yd;

  ClosedChainAccelerations result;
  evaluator.Ocd(0, std::span<const double>(&t, 1), states);
  int failure = 0;
  evaluator.Rma(0, std::span<const double* const>(&common_state, 1),
                std::span<double* const>(&common_derivative, 1),
                result.a_r.data(), std::span<int>(&failure, 1));
  if (const auto error = evaluator.TakeError()) std::rethrow_exception(error);
  if (failure != 0) {
    throw std::runtime_error(system.DescribeFailure(failure) +
                             " at t = " + std::to_string(t) + " s");
  }
  evaluator.Ccd(result.a_r.data(), derivatives);
  for (int k = 0; k < m; ++k) {
    result.qdd.push_back(rates[k].tail(system.chain_size(k) / 2));
    result.tau.push_back(evaluator.Torques(k));
    result.f.push_back(evaluator.TipForce(k));
  }
  return result;
}

}  // namespace dynamics
