#include "dynamics/puma560.h"

#include <gtest/gtest.h>

#include <cmath>

#include "dynamics/kinematics.h"
#include "tests/dynamics/support.h"

namespace dynamics {
namespace {

// At q = 0 the upper arm lies along x, the forearm points up; joints 2 and 3
// turn about -y. All figures below are read off the table in that position.
class PumaAtZero : public testing::Test {
 protected:
  PumaAtZero() : terms_(6) {
    const Chain chain = {.arm = Puma560()};
    const Eigen::VectorXd zero = Eigen::VectorXd::Zero(6);
    CalcChainTerms(MakeChainConstants<double>({&chain}, {0, 0, -9.81}),
                   zero.data(), zero.data(), &terms_);
  }
  static double Square(double x) { return x * x; }

  ChainTerms<double> terms_;
};

TEST_F(PumaAtZero, FlangeIsAtTheSumOfTheLinks) {
  const Eigen::Isometry3d tip =
      CalcMemberPose({.arm = Puma560()}, Eigen::VectorXd::Zero(6));
  const Eigen::Vector3d p(0.4318 + 0.0203, -0.15005, 0.4318 + 0.05625);
  EXPECT_TRUE(IsClose(tip.translation(), p, kDirect));
  EXPECT_TRUE(IsClose(tip.linear(), Eigen::Matrix3d::Identity(), kDirect));
}

// The lever arms are the x of the centres of mass: 0.4318 - 0.3638 of link 2,
// 0.4318 of link 3, 0.4521 of the wrist.
TEST_F(PumaAtZero, GravityTorquesAreThoseOfTheLevers) {
  EXPECT_NEAR(terms_.bias[0], 0, kDirect);
  EXPECT_NEAR(terms_.bias[1],
              9.81 * (17.4 * 0.068 + 4.8 * 0.4318 + 1.25 * 0.4521),
              40 * kDirect);
  EXPECT_NEAR(terms_.bias[2], 9.81 * 1.25 * 0.0203, 40 * kDirect);
}

TEST_F(PumaAtZero, InertiaAboutTheWaistIsThatOfTheTable) {
  const double expected = 0.35 +  //
                          0.524 + 17.4 * (Square(0.068) + Square(0.2275)) +
                          0.0125 + 4.8 * (Square(0.4318) + Square(0.16415)) +
                          1.3e-3 + 0.3e-3 + 0.04e-3 +
                          1.25 * (Square(0.4521) + Square(0.15005));
  EXPECT_NEAR(terms_.H(0, 0), expected, 3 * kDirect);
}

TEST_F(PumaAtZero, InertiaAboutTheElbowIsThatOfTheTable) {
  const double expected =
      0.086 + 4.8 * Square(0.070) +  //
      1.8e-3 + 0.82 * (Square(0.0203) + Square(0.4318 + 0.019)) + 0.4e-3 +
      0.34 * (Square(0.0203) + Square(0.4318)) + 0.15e-3 +
      0.09 * (Square(0.0203) + Square(0.4318 + 0.032));
  EXPECT_NEAR(terms_.H(2, 2), expected, kDirect);
}

TEST_F(PumaAtZero, InertiaAboutTheFlangeIsThatOfLinkSix) {
  EXPECT_NEAR(terms_.H(5, 5), 0.04e-3, 1e-3 * kDirect);
}

TEST(Puma560, AgreesWithLagrangesEquations) {
  support::Random random(1);
  for (const bool rotor_inertia : {false, true}) {
    const Chain chain = {.arm = Puma560(rotor_inertia)};
    for (int i = 0; i < 10; ++i) {
      const Eigen::VectorXd q = random.Vector(6, 3.0);
      const Eigen::VectorXd qd = random.Vector(6, 2.0);
      const Eigen::Vector3d gravity(0, 0, -9.81);
      const auto oracle = support::CalcLagrangeTerms(chain, q, qd, gravity);
      ChainTerms<double> terms(6);
      CalcChainTerms(MakeChainConstants<double>({&chain}, gravity), q.data(),
                     qd.data(), &terms);
      const Eigen::MatrixXd H = terms.H.selfadjointView<Eigen::Lower>();
      EXPECT_TRUE(IsClose(H, oracle.H, kDirect));
      EXPECT_TRUE(IsClose(terms.bias, oracle.C + oracle.G, kDirect, 1));
    }
  }
}

TEST(Puma560, RotorInertiaIsGearRatioSquaredTimesThatOfTheMotor) {
  const double expected[] = {
      200e-6 * 62.6111 * 62.6111, 200e-6 * 107.815 * 107.815,
      200e-6 * 53.7063 * 53.7063, 33e-6 * 76.0364 * 76.0364,
      33e-6 * 71.923 * 71.923,    33e-6 * 76.686 * 76.686};
  const ArmModel with = Puma560(true), without = Puma560();
  for (int i = 0; i < 6; ++i) {
    EXPECT_NEAR(with.links[i].rotor_inertia, expected[i], 3 * kDirect);
    EXPECT_EQ(without.links[i].rotor_inertia, 0);
  }
}

}  // namespace
}  // namespace dynamics
