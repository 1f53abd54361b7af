#include "dynamics/kinematics.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "dynamics/ldlt.h"

namespace dynamics {
namespace {

// Rotation vector that turns the axes `from` into `to`, world axes.
Eigen::Vector3d RotationBetween(const Eigen::Matrix3d& from,
                                const Eigen::Matrix3d& to) {
  const Eigen::AngleAxisd turn(to * from.transpose());
  return turn.angle() * turn.axis();
}

Eigen::Isometry3d MemberPose(const ChainConstants<double>& constants,
                             const ChainTerms<double>& terms) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = terms.R.back() * constants.R_member;
  pose.translation() = terms.P;
  return pose;
}

Eigen::MatrixXd Columns(const Eigen::MatrixXd& J,
                        const std::vector<int>& joints) {
  Eigen::MatrixXd columns(6, joints.size());
  for (std::size_t i = 0; i < joints.size(); ++i) {
    columns.col(static_cast<Eigen::Index>(i)) = J.col(joints[i]);
  }
  return columns;
}

}  // namespace

Eigen::Isometry3d CalcMemberPose(const Chain& chain, const Eigen::VectorXd& q) {
  const auto constants =
      MakeChainConstants<double>({&chain}, Eigen::Vector3d::Zero());
  ChainTerms<double> terms(chain.arm.num_joints());
  const Eigen::VectorXd qd = Eigen::VectorXd::Zero(q.size());
  CalcChainTerms(constants, q.data(), qd.data(), &terms);
  return MemberPose(constants, terms);
}

Eigen::MatrixXd Jacobian(const ChainTerms<double>& terms) {
  Eigen::MatrixXd J(6, terms.J.size());
  for (std::size_t i = 0; i < terms.J.size(); ++i) {
    J.col(static_cast<Eigen::Index>(i)) << terms.J[i].angular,
        terms.J[i].linear;
  }
  return J;
}

std::vector<int> ChooseCarryingJoints(const Chain& chain,
                                      const Eigen::VectorXd& q,
                                      const std::string& where) {
  const int n = chain.arm.num_joints();
  if (n < 6) {
    throw std::runtime_error(
        where + " has " + std::to_string(n) +
        " joints: expected at least six, to hold the reference member in all "
        "directions (Lambda^-1 is not invertible)");
  }
  const auto constants =
      MakeChainConstants<double>({&chain}, Eigen::Vector3d::Zero());
  ChainTerms<double> terms(n);
  const Eigen::VectorXd qd = Eigen::VectorXd::Zero(n);
  CalcChainTerms(constants, q.data(), qd.data(), &terms);
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(Jacobian(terms));
  qr.setThreshold(kSingularJacobian);
  if (qr.rank() < 6) {
    throw std::runtime_error(where +
                             " is at a singularity (Lambda^-1 is not "
                             "invertible)");
  }
  const auto& order = qr.colsPermutation().indices();
  std::vector<int> joints(order.data(), order.data() + 6);
  std::sort(joints.begin(), joints.end());
  return joints;
}

Eigen::VectorXd SolveInverseKinematics(const Chain& chain,
                                       const Eigen::Isometry3d& target,
                                       const std::vector<int>& joints,
                                       Eigen::VectorXd q,
                                       const std::string& where) {
  constexpr int kMaxIterations = 100;
  constexpr double kMaxStep = 0.3;      // rad or m, keeps Newton on its branch
  constexpr double kConverged = 1e-11;  // rad and m; the step after it is exact
  const auto constants =
      MakeChainConstants<double>({&chain}, Eigen::Vector3d::Zero());
  ChainTerms<double> terms(chain.arm.num_joints());
  const Eigen::VectorXd qd = Eigen::VectorXd::Zero(q.size());
  Vector6<double> miss;
  for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
    CalcChainTerms(constants, q.data(), qd.data(), &terms);
    const Eigen::Isometry3d pose = MemberPose(constants, terms);
    miss << RotationBetween(pose.linear(), target.linear()),
        target.translation() - pose.translation();
    Eigen::VectorXd step =
        Columns(Jacobian(terms), joints).colPivHouseholderQr().solve(miss);
    const double longest = step.lpNorm<Eigen::Infinity>();
    if (!std::isfinite(longest)) break;
    if (longest > kMaxStep) step *= kMaxStep / longest;
    for (std::size_t i = 0; i < joints.size(); ++i) {
      q[joints[i]] += step[static_cast<Eigen::Index>(i)];
    }
    if (miss.lpNorm<Eigen::Infinity>() < kConverged) return q;
  }
  throw std::runtime_error(where + " cannot reach its grip: the last try is " +
                           std::to_string(miss.tail<3>().norm()) + " m and " +
                           std::to_string(miss.head<3>().norm()) + " rad away");
}

Eigen::VectorXd CalcInverseDynamics(const ChainTerms<double>& terms,
                                    const Eigen::VectorXd& qdd,
                                    const Vector6<double>& f) {
  return terms.H.selfadjointView<Eigen::Lower>() * qdd + terms.bias +
         Jacobian(terms).transpose() * f;
}

}  // namespace dynamics
