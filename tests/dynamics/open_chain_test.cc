#include "dynamics/open_chain.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <limits>

#include "dynamics/lift.h"
#include "tests/dynamics/support.h"

namespace dynamics {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

template <typename S>
OpenChain<S> Calc(const Batch<S>& batch) {
  const int n = batch.chains[0].arm.num_joints();
  const VectorX<S> q = Interleave<S>(batch.q);
  const VectorX<S> qd = Interleave<S>(batch.qd);
  const VectorX<S> tau = Interleave<S>(batch.tau);
  OpenChainWork<S> work(n);
  OpenChain<S> open(n);
  CalcOpenChain(batch.Constants(), q.data(), qd.data(), tau.data(), &work,
                &open);
  return open;
}

template <typename S>
void ExpectSameLane(const OpenChain<S>& a, const OpenChain<S>& b, int lane) {
  EXPECT_TRUE(HasSameBits(LaneOf(a.qdd_open, lane), LaneOf(b.qdd_open, lane)));
  EXPECT_TRUE(HasSameBits(LaneOf(a.Hinv_JT, lane), LaneOf(b.Hinv_JT, lane)));
  EXPECT_TRUE(HasSameBits(LaneOf(a.a_open, lane), LaneOf(b.a_open, lane)));
  EXPECT_TRUE(HasSameBits(LaneOf(a.Lambda, lane), LaneOf(b.Lambda, lane)));
  EXPECT_TRUE(HasSameBits(LaneOf(a.Lambda_a_open, lane),
                          LaneOf(b.Lambda_a_open, lane)));
  EXPECT_TRUE(SameBits(Lane(a.margin, lane), Lane(b.margin, lane)));
}

template <typename S>
class OpenChainTest : public testing::Test {};
TYPED_TEST_SUITE(OpenChainTest, Scalars);

TYPED_TEST(OpenChainTest, AgreesWithDenseSolutionOfLagrangesEquations) {
  support::Random random(1);
  for (int n = 6; n <= 9; ++n) {
    for (int num_prismatic = 0; num_prismatic <= 2; ++num_prismatic) {
      const Batch<TypeParam> batch(n, num_prismatic, &random);
      const OpenChain<TypeParam> open = Calc(batch);
      for (int lane = 0; lane < batch.num_lanes(); ++lane) {
        const support::LagrangeTerms oracle = batch.Oracle(lane);
        const auto H = oracle.H.fullPivLu();
        const support::MatrixXl Hinv_JT = H.solve(oracle.J.transpose().eval());
        const support::VectorXl qdd =
            H.solve((batch.tau[lane].template cast<support::Real>() - oracle.C -
                     oracle.G)
                        .eval());
        const support::VectorXl a_open = oracle.Jd_qd + oracle.J * qdd;
        const support::MatrixXl Lambda =
            (oracle.J * Hinv_JT).fullPivLu().inverse();
        EXPECT_GT(Lane(open.margin, lane), 0);
        EXPECT_TRUE(IsClose(LaneOf(open.qdd_open, lane), qdd, kInverted));
        EXPECT_TRUE(IsClose(LaneOf(open.Hinv_JT, lane), Hinv_JT, kInverted));
        EXPECT_TRUE(IsClose(LaneOf(open.a_open, lane), a_open, kInverted));
        EXPECT_TRUE(IsClose(LaneOf(open.Lambda, lane), Lambda, kInverted));
        EXPECT_TRUE(IsClose(LaneOf(open.Lambda_a_open, lane), Lambda * a_open,
                            kInverted));
      }
    }
  }
}

TYPED_TEST(OpenChainTest, LambdaIsSymmetricAndFillsBothTriangles) {
  support::Random random(2);
  const Batch<TypeParam> batch(6, 1, &random);
  const OpenChain<TypeParam> open = Calc(batch);
  for (int lane = 0; lane < batch.num_lanes(); ++lane) {
    const Eigen::MatrixXd Lambda = LaneOf(open.Lambda, lane);
    EXPECT_TRUE(HasSameBits(Lambda, Lambda.transpose()));
    EXPECT_EQ(Lambda.llt().info(), Eigen::Success);
  }
}

TYPED_TEST(OpenChainTest, FreeTipAcceleratesAsTheJointsCarryIt) {
  support::Random random(3);
  const Batch<TypeParam> batch(8, 2, &random);
  const OpenChain<TypeParam> open = Calc(batch);
  for (int lane = 0; lane < batch.num_lanes(); ++lane) {
    const support::CarriedMember member =
        support::CalcCarriedMember(batch.chains[lane], batch.q[lane],
                                   batch.qd[lane], LaneOf(open.qdd_open, lane));
    EXPECT_TRUE(
        IsClose(LaneOf(open.a_open, lane), member.acceleration, kInverted));
  }
}

TYPED_TEST(OpenChainTest, OfFewerThanSixJointsIsExactButForLambda) {
  support::Random random(4);
  for (int n = 1; n <= 5; ++n) {
    const Batch<TypeParam> batch(n, n / 3, &random);
    const OpenChain<TypeParam> open = Calc(batch);
    for (int lane = 0; lane < batch.num_lanes(); ++lane) {
      const support::LagrangeTerms oracle = batch.Oracle(lane);
      const support::VectorXl qdd = oracle.H.fullPivLu().solve(
          (batch.tau[lane].template cast<support::Real>() - oracle.C - oracle.G)
              .eval());
      EXPECT_FALSE(Lane(open.margin, lane) > 0) << n << " joints";
      EXPECT_TRUE(IsClose(LaneOf(open.qdd_open, lane), qdd, kInverted));
    }
  }
}

// One PUMA among others that are sound: margin of each lane.
template <typename S>
void ExpectSingularInItsLaneOnly(const Eigen::VectorXd& singular) {
  support::Random random(5);
  Batch<S> batch(6, 0, &random);
  for (int lane = 0; lane < batch.num_lanes(); ++lane) {
    batch.chains[lane] = PumaLift().model.chains[lane];
    batch.q[lane] =
        (Eigen::VectorXd(6) << 0.3, -0.4, -2.5, 0.3, 1.3, 0).finished();
  }
  const OpenChain<S> sound = Calc(batch);
  for (int at = 0; at < batch.num_lanes(); ++at) {
    Batch<S> changed = batch;
    changed.q[at] = singular;
    const OpenChain<S> open = Calc(changed);
    for (int lane = 0; lane < batch.num_lanes(); ++lane) {
      if (lane == at) {
        EXPECT_FALSE(Lane(open.margin, lane) > 0) << singular.transpose();
      } else {
        EXPECT_GT(Lane(open.margin, lane), 0);
        ExpectSameLane(open, sound, lane);
      }
    }
  }
}

// Angles of shoulder and elbow.
constexpr double kPostures[][2] = {{-0.8, -2.8}, {-0.5, -2.0}, {0.6, -2.6}};

TYPED_TEST(OpenChainTest, MarginIsNotPositiveWithTheWristOfThePumaStraight) {
  for (const auto& [shoulder, elbow] : kPostures) {
    Eigen::VectorXd q(6);
    q << 0.3, shoulder, elbow, 0.3, 0, -0.1;  // axes 4 and 6 in line
    ExpectSingularInItsLaneOnly<TypeParam>(q);
  }
}

TYPED_TEST(OpenChainTest, MarginIsNotPositiveWithTheElbowOfThePumaStraight) {
  for (const double shoulder : {-0.8, -0.5, 0.6}) {
    Eigen::VectorXd q(6);
    q << 0.3, shoulder, 0, 0.3, 1.3, -0.1;
    q[2] = std::atan2(-0.4318, 0.0203);  // wrist on the line of the upper arm
    ExpectSingularInItsLaneOnly<TypeParam>(q);
  }
}

TYPED_TEST(OpenChainTest, MarginIsNotPositiveWhereThePositionIsNan) {
  for (int i = 0; i < 6; ++i) {
    Eigen::VectorXd q = Eigen::VectorXd::Constant(6, 0.5);
    q[i] = kNan;
    ExpectSingularInItsLaneOnly<TypeParam>(q);
  }
}

TYPED_TEST(OpenChainTest, MarginIsNotPositiveWithoutMass) {
  support::Random random(8);
  Batch<TypeParam> batch(6, 0, &random);
  for (Link& link : batch.chains[0].arm.links) {
    link.mass = link.rotor_inertia = 0;
    link.inertia.setZero();
  }
  EXPECT_FALSE(Lane(Calc(batch).margin, 0) > 0);
}

TEST(OpenChain, LaneDoesNotDependOnItsNeighboursBitForBit) {
  support::Random random(9);
  const Batch<Pack<4>> batch(7, 1, &random);
  const auto together = Calc(batch);
  for (int lane = 0; lane < 4; ++lane) {
    for (const double torque : {kNan, 1e300, 0.0}) {
      Batch<Pack<4>> other = batch;
      for (int l = 0; l < 4; ++l) {
        if (l != lane) other.tau[l].setConstant(torque);
        if (l != lane) other.q[l] = batch.q[(l + 1) % 4];
      }
      ExpectSameLane(Calc(other), together, lane);
    }
  }
}

}  // namespace
}  // namespace dynamics
