#include "dynamics/kinematics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "dynamics/lift.h"
#include "tests/dynamics/support.h"

namespace dynamics {
namespace {

TEST(CalcMemberPose, IsThatOfTheTransforms) {
  support::Random random(1);
  for (int n = 1; n <= 9; ++n) {
    const Chain chain = support::RandomChain(n, n / 3, &random);
    const Eigen::VectorXd q = random.Vector(n, 2.0);
    const Eigen::VectorXd zero = Eigen::VectorXd::Zero(n);
    const auto oracle = support::CalcCarriedMember(chain, q, zero, zero);
    const Eigen::Isometry3d pose = CalcMemberPose(chain, q);
    EXPECT_TRUE(IsClose(pose.linear(), oracle.R, kDirect));
    EXPECT_TRUE(IsClose(pose.translation(), oracle.P, kDirect));
  }
}

TEST(SolveInverseKinematics, ReturnsToThePose) {
  support::Random random(2);
  for (int n = 6; n <= 9; ++n) {
    for (int num_prismatic = 0; num_prismatic <= 2; ++num_prismatic) {
      const Chain chain = support::RandomChain(n, num_prismatic, &random);
      const Eigen::VectorXd q = support::RandomRegularPosition(chain, &random);
      const Eigen::Isometry3d target = CalcMemberPose(chain, q);
      const auto joints = ChooseCarryingJoints(chain, q, "chain 0");
      const Eigen::VectorXd guess = q + random.Vector(n, 0.02);
      const Eigen::VectorXd found =
          SolveInverseKinematics(chain, target, joints, guess, "chain 0");
      const Eigen::Isometry3d pose = CalcMemberPose(chain, found);
      EXPECT_TRUE(IsClose(pose.matrix(), target.matrix(), kDirect));
      for (int i = 0; i < n; ++i) {
        if (!std::count(joints.begin(), joints.end(), i)) {
          EXPECT_EQ(found[i], guess[i]) << "joint held";
        }
      }
      // Without redundancy it is the same branch.
      if (n == 6) {
        EXPECT_TRUE(IsClose(found, q, 1e-9));
      }
    }
  }
}

TEST(SolveInverseKinematics, SaysByHowMuchAnUnreachableGripIsMissed) {
  const Lift lift = PumaLift();
  const Chain& chain = lift.model.chains[0];
  Eigen::Isometry3d target = Eigen::Isometry3d::Identity();
  target.translation() = Eigen::Vector3d(0, 0, 5);
  const std::string complaint = MessageOf<std::runtime_error>([&] {
    (void)SolveInverseKinematics(chain, target, {0, 1, 2, 3, 4, 5},
                                 lift.q_guess[0], "chain 2 at t = 0.5 s");
  });
  EXPECT_EQ(complaint.rfind("chain 2 at t = 0.5 s cannot reach its grip: the "
                            "last try is ",
                            0),
            0u)
      << complaint;
  EXPECT_TRUE(Contains(complaint, " m and ")) << complaint;
  EXPECT_TRUE(Contains(complaint, " rad away")) << complaint;
}

TEST(SolveInverseKinematics, GivesUpOnANanTarget) {
  const Lift lift = PumaLift();
  Eigen::Isometry3d target = Eigen::Isometry3d::Identity();
  target.translation()[1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(
      (void)SolveInverseKinematics(lift.model.chains[0], target,
                                   {0, 1, 2, 3, 4, 5}, lift.q_guess[0], "it"),
      std::runtime_error);
}

TEST(ChooseCarryingJoints, AreSixInAscendingOrder) {
  support::Random random(3);
  for (int n = 6; n <= 9; ++n) {
    const Chain chain = support::RandomChain(n, 1, &random);
    const Eigen::VectorXd q = support::RandomRegularPosition(chain, &random);
    const auto joints = ChooseCarryingJoints(chain, q, "chain 0");
    ASSERT_EQ(joints.size(), 6u);
    for (int i = 0; i < 5; ++i) EXPECT_LT(joints[i], joints[i + 1]);
    EXPECT_GE(joints.front(), 0);
    EXPECT_LT(joints.back(), n);
  }
}

TEST(ChooseCarryingJoints, NamesAChainWithFewerThanSixJoints) {
  support::Random random(4);
  const Chain chain = support::RandomChain(4, 0, &random);
  const std::string complaint = MessageOf<std::runtime_error>([&] {
    (void)ChooseCarryingJoints(chain, Eigen::VectorXd::Zero(4), "chain 3");
  });
  EXPECT_EQ(complaint.rfind("chain 3 has 4 joints: ", 0), 0u) << complaint;
}

TEST(ChooseCarryingJoints, NamesAChainAtASingularity) {
  const Lift lift = PumaLift();
  Eigen::VectorXd q = lift.q_guess[0];
  q[4] = 0;
  EXPECT_EQ(MessageOf<std::runtime_error>([&] {
              (void)ChooseCarryingJoints(lift.model.chains[0], q, "chain 3");
            }),
            "chain 3 is at a singularity (Lambda^-1 is not invertible)");
}

TEST(CalcInverseDynamics, IsEquationOneOfTheOracle) {
  support::Random random(5);
  using support::Real;
  for (int n = 1; n <= 9; ++n) {
    const Chain chain = support::RandomChain(n, n / 3, &random);
    const Eigen::VectorXd q = random.Vector(n, 2.0);
    const Eigen::VectorXd qd = random.Vector(n, 1.0);
    const Eigen::VectorXd qdd = random.Vector(n, 5.0);
    const Vector6<double> f = random.Vector(6, 20.0);
    const Eigen::Vector3d gravity(1, 2, -9);
    ChainTerms<double> terms(n);
    CalcChainTerms(MakeChainConstants<double>({&chain}, gravity), q.data(),
                   qd.data(), &terms);
    const auto oracle = support::CalcLagrangeTerms(chain, q, qd, gravity);
    EXPECT_TRUE(IsClose(CalcInverseDynamics(terms, qdd, f),
                        oracle.H * qdd.cast<Real>() + oracle.C + oracle.G +
                            oracle.J.transpose() * f.cast<Real>(),
                        kDirect));
    EXPECT_TRUE(IsClose(Jacobian(terms), oracle.J, kDirect));
  }
}

}  // namespace
}  // namespace dynamics
