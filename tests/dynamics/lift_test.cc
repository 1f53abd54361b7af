#include "dynamics/lift.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "dynamics/kinematics.h"
#include "tests/dynamics/support.h"

namespace dynamics {
namespace {

TEST(PumaLift, EveryChainHoldsTheLoadWhereItStarts) {
  for (const int num_chains : {1, 2, 3, 4, 7, 16}) {
    const Lift lift = PumaLift(num_chains);
    ASSERT_EQ(lift.model.num_chains(), num_chains);
    const Eigen::Isometry3d start = lift.motion(0).pose;
    for (int k = 0; k < num_chains; ++k) {
      const Eigen::Isometry3d pose =
          CalcMemberPose(lift.model.chains[k], lift.q_guess[k]);
      // The guess has ten digits.
      EXPECT_TRUE(IsClose(pose.matrix(), start.matrix(), 1e-9)) << k;
    }
  }
}

TEST(PumaLift, LiftsFourKilogramsByEightTenthsInOneSecond) {
  const Lift lift = PumaLift();
  EXPECT_EQ(lift.model.num_chains(), 4);
  EXPECT_EQ(lift.model.member.mass, 4);
  EXPECT_EQ(lift.model.member.inertia.diagonal(),
            Eigen::Vector3d(0.05, 0.06, 0.08));
  EXPECT_EQ(lift.model.gravity, Eigen::Vector3d(0, 0, -9.81));
  EXPECT_EQ(lift.duration, 1);
  EXPECT_TRUE(IsClose(lift.motion(0).pose.translation(),
                      Eigen::Vector3d(0, 0, -0.6), kDirect));
  EXPECT_TRUE(IsClose(lift.motion(1).pose.translation(), lift.end, kDirect));
  EXPECT_EQ(lift.end, Eigen::Vector3d(0, 0, 0.2));
}

TEST(PumaLift, ShouldersStandAroundTheLoadAndGrippersPointInward) {
  const Lift lift = PumaLift();
  for (int k = 0; k < 4; ++k) {
    const Chain& chain = lift.model.chains[k];
    const double phi = k * std::acos(-1.0) / 2;
    const Eigen::Vector3d outward(std::cos(phi), std::sin(phi), 0);
    EXPECT_TRUE(IsClose(chain.base.translation(), 0.75625 * outward, kDirect));
    EXPECT_TRUE(IsClose(chain.base.linear().col(0), -outward, kDirect));
    // The tip, in the axes of the load.
    const Eigen::Isometry3d tip = chain.grip.inverse();
    EXPECT_TRUE(IsClose(tip.translation(), 0.2 * outward, kDirect));
    EXPECT_TRUE(IsClose(tip.linear().col(2), -outward, kDirect));
    EXPECT_TRUE(IsClose(tip.linear().col(1),
                        Eigen::Vector3d::UnitZ().cross(-outward), kDirect));
    EXPECT_NEAR(tip.linear().determinant(), 1, kDirect);
  }
}

TEST(PumaLift, KeepsAsFarFromSingularitiesAsItSays) {
  const Lift lift = PumaLift();
  const Plan plan = MakePlan(lift.model, lift.motion, 0.01, 100, lift.q_guess);
  double smallest = 1;
  for (int n = 0; n <= 100; ++n) {
    const auto oracle = support::CalcLagrangeTerms(
        lift.model.chains[0], plan.states[0].col(n).head(6),
        Eigen::VectorXd::Zero(6), lift.model.gravity);
    const Eigen::Matrix<double, 6, 6> J = oracle.J.cast<double>();
    smallest = std::min(smallest, std::abs(J.determinant()));
  }
  EXPECT_NEAR(smallest, 0.0458, 0.5e-4);  // the printed digits
}

TEST(PumaLift, CarriesRotorInertiaOnRequest) {
  EXPECT_EQ(PumaLift(1).model.chains[0].arm.links[0].rotor_inertia, 0);
  EXPECT_GT(PumaLift(1, true).model.chains[0].arm.links[0].rotor_inertia, 0);
}

}  // namespace
}  // namespace dynamics
