#include "dynamics/lift.h"

#include <cmath>
#include <numbers>

#include "dynamics/puma560.h"

namespace dynamics {
namespace {

// Arm at the angle phi around the z axis. The tip's z axis points inward, its y
// axis along up x inward; the load starts with the axes of the world.
Chain ChainAt(double phi, bool rotor_inertia) {
  constexpr double kShoulderRadius = 0.75625;  // m
  constexpr double kGripRadius = 0.2;          // m
  const Eigen::Vector3d outward(std::cos(phi), std::sin(phi), 0);
  const Eigen::Vector3d up = Eigen::Vector3d::UnitZ();

  Eigen::Matrix3d tip;
  tip.col(2) = -outward;
  tip.col(1) = up.cross(tip.col(2));
  tip.col(0) = tip.col(1).cross(tip.col(2));

  Chain chain;
  chain.arm = Puma560(rotor_inertia);
  chain.base.translate(kShoulderRadius * outward);
  chain.base.rotate(Eigen::AngleAxisd(phi + std::numbers::pi, up));
  chain.grip.linear() = tip.transpose();
  chain.grip.translation() = Eigen::Vector3d(0, 0, kGripRadius);
  return chain;
}

}  // namespace

Lift PumaLift(int num_chains, bool rotor_inertia) {
  Lift lift;
  for (int k = 0; k < num_chains; ++k) {
    const double phi = 2 * std::numbers::pi * k / num_chains;
    lift.model.chains.push_back(ChainAt(phi, rotor_inertia));
    Eigen::VectorXd q(6);  // elbow up
    q << 0.3047974842, -0.4189813149, -2.4835986831, 0.3131513520, 1.3429999007,
        -0.0729955860;
    lift.q_guess.push_back(q);
  }
  lift.model.member.mass = 4;
  lift.model.member.inertia = Eigen::Vector3d(0.05, 0.06, 0.08).asDiagonal();
  lift.duration = 1;
  lift.end = Eigen::Vector3d(0, 0, 0.2);
  lift.motion =
      StraightLift(Eigen::Vector3d(0, 0, -0.6), lift.end, lift.duration);
  return lift;
}

}  // namespace dynamics
