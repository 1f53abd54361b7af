#include "tests/support/random_system.h"

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

namespace support {
namespace {

using Svd = Eigen::JacobiSVD<Eigen::MatrixXd>;

Eigen::Isometry3d CarriedPose(const dynamics::Chain& chain,
                              const Eigen::VectorXd& q) {
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(q.size());
  const CarriedMember member = CalcCarriedMember(chain, q, zero, zero);
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = member.R.cast<double>();
  pose.translation() = member.P.cast<double>();
  return pose;
}

Eigen::MatrixXd CalcJacobian(const dynamics::Chain& chain,
                             const Eigen::VectorXd& q) {
  const auto n = q.size();
  Eigen::MatrixXd J(6, n);
  for (int i = 0; i < n; ++i) {
    J.col(i) = CalcCarriedMember(chain, q, Eigen::VectorXd::Unit(n, i),
                                 Eigen::VectorXd::Zero(n))
                   .velocity.cast<double>();
  }
  return J;
}

// Rates with J q' = velocity: the shortest, and something J does not see.
Eigen::VectorXd RandomRates(const Eigen::MatrixXd& J,
                            const Eigen::VectorXd& velocity, Random* random) {
  const Svd svd(J, Eigen::ComputeThinU | Eigen::ComputeThinV);
  const Eigen::VectorXd any = random->Vector(static_cast<int>(J.cols()), 1.0);
  return svd.solve(velocity) + any - svd.solve(J * any);
}

}  // namespace

double Random::Uniform(double low, double high) {
  const double unit = std::ldexp(static_cast<double>(engine_() >> 11), -53);
  return low + (high - low) * unit;
}

int Random::Integer(int end) { return static_cast<int>(Uniform(0, end)); }

Eigen::VectorXd Random::Vector(int size, double magnitude) {
  Eigen::VectorXd v(size);
  for (double& x : v) x = Uniform(-magnitude, magnitude);
  return v;
}

Eigen::Matrix3d Random::Rotation() {
  const Eigen::Vector4d Q = Vector(4, 1.0);
  return Eigen::Quaterniond(Q).normalized().toRotationMatrix();
}

Eigen::Isometry3d Random::Pose(double reach) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = Rotation();
  pose.translation() = Vector(3, reach);
  return pose;
}

Eigen::Matrix3d Random::Inertia() {
  const Eigen::Matrix3d R = Rotation();
  const Eigen::Vector3d principal(Uniform(0.02, 0.2), Uniform(0.02, 0.2),
                                  Uniform(0.02, 0.2));
  const Eigen::Matrix3d I = R * principal.asDiagonal() * R.transpose();
  return (I + I.transpose()) / 2;
}

dynamics::ArmModel RandomArm(int num_joints, int num_prismatic,
                             Random* random) {
  dynamics::ArmModel arm;
  arm.name = "random arm";
  arm.links.resize(num_joints);
  for (dynamics::Link& link : arm.links) {
    link.parent_to_joint = random->Pose(0.4);
    link.mass = random->Uniform(0.5, 4);
    link.com = random->Vector(3, 0.2);
    link.inertia = random->Inertia();
    link.rotor_inertia = std::max(0.0, random->Uniform(-0.2, 0.2));
  }
  for (int count = 0; count < num_prismatic;) {
    dynamics::Link& link = arm.links[random->Integer(num_joints)];
    if (link.type == dynamics::JointType::kPrismatic) continue;
    link.type = dynamics::JointType::kPrismatic;
    ++count;
  }
  arm.tip = random->Pose(0.3);
  return arm;
}

dynamics::Chain RandomChain(int num_joints, int num_prismatic, Random* random) {
  return {.arm = RandomArm(num_joints, num_prismatic, random),
          .base = random->Pose(1.0),
          .grip = random->Pose(0.3)};
}

Eigen::VectorXd RandomRegularPosition(const dynamics::Chain& chain,
                                      Random* random) {
  constexpr int kNumTries = 10;
  Eigen::VectorXd best;
  double best_ratio = 0;
  for (int i = 0; i < kNumTries; ++i) {
    const Eigen::VectorXd q = random->Vector(chain.arm.num_joints(), 2.0);
    const Eigen::VectorXd sigma = Svd(CalcJacobian(chain, q)).singularValues();
    if (sigma[5] > best_ratio * sigma[0]) {
      best_ratio = sigma[5] / sigma[0];
      best = q;
    }
  }
  return best;
}

dynamics::Chain RandomChainHolding(const Eigen::Isometry3d& pose,
                                   int num_joints, int num_prismatic,
                                   Random* random, Eigen::VectorXd* q) {
  dynamics::Chain chain = RandomChain(num_joints, num_prismatic, random);
  *q = RandomRegularPosition(chain, random);
  chain.base = pose * CarriedPose(chain, *q).inverse() * chain.base;
  return chain;
}

RandomSystem MakeRandomSystem(const std::vector<int>& num_joints,
                              std::uint64_t seed) {
  Random random(seed);
  RandomSystem system;
  system.model.member.mass = random.Uniform(1, 8);
  system.model.member.inertia = random.Inertia();
  system.model.gravity = random.Vector(3, 10.0);

  const Eigen::Isometry3d pose = random.Pose(1.0);
  SystemState& state = system.state;
  state.Q = Eigen::Quaterniond(pose.linear());
  state.p = pose.translation();
  state.omega = random.Vector(3, 1.0);
  state.v = random.Vector(3, 1.0);
  Eigen::VectorXd velocity(6);
  velocity << state.omega, state.v;

  for (const int n : num_joints) {
    Eigen::VectorXd q;
    system.model.chains.push_back(
        RandomChainHolding(pose, n, 1 + random.Integer(2), &random, &q));
    const Eigen::MatrixXd J = CalcJacobian(system.model.chains.back(), q);
    state.q.push_back(q);
    state.qd.push_back(RandomRates(J, velocity, &random));
    system.tau.push_back(random.Vector(n, 20.0));
  }
  return system;
}

}  // namespace support
