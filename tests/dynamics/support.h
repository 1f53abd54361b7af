#pragma once

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <bit>
#include <cstdint>
#include <string>
#include <vector>

#include "dynamics/chain_terms.h"
#include "dynamics/closed_chain_system.h"
#include "tests/support/kkt_oracle.h"
#include "tests/support/random_system.h"

// What the tests of dynamics share: comparison, lanes, and chains in batches.

namespace dynamics {

// For results without an inversion: sums of some hundred products of figures
// of order one, 5000 epsilon.
inline constexpr double kDirect = 1e-12;
// For accelerations and forces: cond(J H^-1 J^T) of a PUMA is 2.4e5, which
// leaves 1e-12 to 1e-11.
inline constexpr double kInverted = 1e-10;

// No element off by more than `tolerance` times the largest expected one (or
// `scale`, if that is larger). NaN is never close.
template <typename A, typename B>
testing::AssertionResult IsClose(const Eigen::MatrixBase<A>& actual,
                                 const Eigen::MatrixBase<B>& expected,
                                 double tolerance, double scale = 0) {
  using support::Real;
  if (actual.rows() != expected.rows() || actual.cols() != expected.cols()) {
    return testing::AssertionFailure() << "the shapes differ";
  }
  const support::MatrixXl a = actual.template cast<Real>();
  const support::MatrixXl b = expected.template cast<Real>();
  const Real error = (a - b).cwiseAbs().maxCoeff();
  const Real largest = std::max<Real>(b.cwiseAbs().maxCoeff(), scale);
  if (a.allFinite() && error <= tolerance * largest) {
    return testing::AssertionSuccess();
  }
  return testing::AssertionFailure()
         << "relative error " << error / largest << " in\n"
         << a.template cast<double>() << "\nwhich should be\n"
         << b.template cast<double>();
}

inline bool SameBits(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}
template <typename A, typename B>
testing::AssertionResult HasSameBits(const Eigen::MatrixBase<A>& a,
                                     const Eigen::MatrixBase<B>& b) {
  for (Eigen::Index i = 0; i < a.rows(); ++i) {
    for (Eigen::Index j = 0; j < a.cols(); ++j) {
      if (!SameBits(a(i, j), b(i, j))) {
        return testing::AssertionFailure()
               << "(" << i << ", " << j << ") is " << a(i, j) << " and "
               << b(i, j) << ", which differ by " << a(i, j) - b(i, j);
      }
    }
  }
  return testing::AssertionSuccess();
}

// One lane of a matrix.
template <typename Derived>
auto LaneOf(const Eigen::MatrixBase<Derived>& m, int lane) {
  return m.unaryExpr([lane](const auto& x) { return Lane(x, lane); }).eval();
}
template <typename S>
Vector6<double> LaneOf(const SpatialVector<S>& v, int lane) {
  Vector6<double> result;
  result << LaneOf(v.angular, lane), LaneOf(v.linear, lane);
  return result;
}
template <typename S>
Eigen::MatrixXd LaneOf(const std::vector<SpatialVector<S>>& v, int lane) {
  Eigen::MatrixXd rows(v.size(), 6);
  for (std::size_t i = 0; i < v.size(); ++i) {
    rows.row(static_cast<Eigen::Index>(i)) = LaneOf(v[i], lane).transpose();
  }
  return rows;
}

// Lane l from lanes[l]; the last one fills what is left over.
template <typename S>
VectorX<S> Interleave(const std::vector<Eigen::VectorXd>& lanes) {
  VectorX<S> v(lanes[0].size());
  for (int lane = 0; lane < kLanesOf<S>; ++lane) {
    const auto l = std::min(static_cast<std::size_t>(lane), lanes.size() - 1);
    for (Eigen::Index i = 0; i < v.size(); ++i)
      SetLane(&v[i], lane, lanes[l][i]);
  }
  return v;
}

// As many random chains as S has lanes, with the same joint types in the same
// order, each in a state of its own.
template <typename S>
struct Batch {
  Batch(int num_joints, int num_prismatic, support::Random* random) {
    for (int lane = 0; lane < kLanesOf<S>; ++lane) {
      Chain chain = support::RandomChain(num_joints, num_prismatic, random);
      for (int i = 0; lane > 0 && i < num_joints; ++i) {
        chain.arm.links[i].type = chains[0].arm.links[i].type;
      }
      q.push_back(num_joints < 6
                      ? random->Vector(num_joints, 2.0)
                      : support::RandomRegularPosition(chain, random));
      chains.push_back(chain);
      qd.push_back(random->Vector(num_joints, 1.0));
      tau.push_back(random->Vector(num_joints, 20.0));
    }
  }
  int num_lanes() const { return static_cast<int>(chains.size()); }
  ChainConstants<S> Constants() const {
    std::vector<const Chain*> pointers;
    for (const Chain& chain : chains) pointers.push_back(&chain);
    return MakeChainConstants<S>(pointers, gravity);
  }
  support::LagrangeTerms Oracle(int lane) const {
    return support::CalcLagrangeTerms(chains[lane], q[lane], qd[lane], gravity);
  }

  std::vector<Chain> chains;
  std::vector<Eigen::VectorXd> q, qd, tau;
  Eigen::Vector3d gravity = {1, -2, -9};
};

using Scalars = testing::Types<double, Pack<4>>;

// The largest q''_open. The q'' of a PUMA that is held at its tip are what is
// left of q''_open and H^-1 J^T f, 1e3 times larger for the light wrist: their
// rounding error is relative to this, and is kDirect.
inline double OpenAcceleration(const Chain& chain, const Eigen::VectorXd& q,
                               const Eigen::VectorXd& qd,
                               const Eigen::VectorXd& tau,
                               const Eigen::Vector3d& gravity) {
  const auto oracle = support::CalcLagrangeTerms(chain, q, qd, gravity);
  const support::VectorXl qdd = oracle.H.fullPivLu().solve(
      (tau.cast<support::Real>() - oracle.C - oracle.G).eval());
  return static_cast<double>(qdd.cwiseAbs().maxCoeff());
}

// The same torques whenever they are asked for.
class ConstantTorques final : public TorqueSource {
 public:
  explicit ConstantTorques(std::vector<Eigen::VectorXd> tau)
      : tau_(std::move(tau)) {}
  void Calc(int k, double /*t*/, const double* /*q*/, const double* /*qd*/,
            double* tau) const override {
    std::copy(tau_[k].begin(), tau_[k].end(), tau);
  }

 private:
  std::vector<Eigen::VectorXd> tau_;
};

inline MemberState<double> MemberOf(const support::SystemState& state) {
  return {.Q = {state.Q.w(), state.Q.x(), state.Q.y(), state.Q.z()},
          .p = state.p,
          .omega = state.omega,
          .v = state.v};
}

inline std::vector<Eigen::VectorXd> ChainStatesOf(
    const support::SystemState& state) {
  std::vector<Eigen::VectorXd> states;
  for (std::size_t k = 0; k < state.q.size(); ++k) {
    states.emplace_back(2 * state.q[k].size());
    states[k] << state.q[k], state.qd[k];
  }
  return states;
}

// What `function` throws, in words; "" if it returns.
template <typename Exception, typename Function>
std::string MessageOf(const Function& function) {
  try {
    function();
  } catch (const Exception& error) {
    return error.what();
  }
  return "";
}

inline bool Contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace dynamics
