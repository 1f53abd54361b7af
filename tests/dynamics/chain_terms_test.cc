#include "dynamics/chain_terms.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/dynamics/support.h"

namespace dynamics {
namespace {

template <typename S>
ChainTerms<S> CalcTerms(const Batch<S>& batch) {
  ChainTerms<S> terms(batch.chains[0].arm.num_joints());
  const VectorX<S> q = Interleave<S>(batch.q);
  const VectorX<S> qd = Interleave<S>(batch.qd);
  CalcChainTerms(batch.Constants(), q.data(), qd.data(), &terms);
  return terms;
}

template <typename S>
Eigen::MatrixXd FullH(const ChainTerms<S>& terms, int lane) {
  return LaneOf(terms.H, lane).template selfadjointView<Eigen::Lower>();
}

template <typename S>
class ChainTermsTest : public testing::Test {
 protected:
  // Calls `check(batch, terms)` for N = 1 ... 9: all joints revolute, all
  // prismatic, and a third of them prismatic.
  template <typename Check>
  static void ForEachKind(const Check& check) {
    support::Random random(1);
    for (int n = 1; n <= 9; ++n) {
      for (const int num_prismatic : {0, n, n / 3}) {
        // J cannot have full rank without three revolute joints, and the terms
        // do not need it.
        Batch<S> batch(std::min(n, 5), 0, &random);
        for (int lane = 0; lane < batch.num_lanes(); ++lane) {
          Chain& chain = batch.chains[lane];
          chain = support::RandomChain(n, num_prismatic, &random);
          for (int i = 0; i < n; ++i) {
            chain.arm.links[i].type = batch.chains[0].arm.links[i].type;
          }
          batch.q[lane] = random.Vector(n, 2.0);
          batch.qd[lane] = random.Vector(n, 1.0);
        }
        SCOPED_TRACE(testing::Message()
                     << "N = " << n << ", prismatic: " << num_prismatic);
        check(batch, CalcTerms(batch));
      }
    }
  }
};
TYPED_TEST_SUITE(ChainTermsTest, Scalars);

TYPED_TEST(ChainTermsTest, AgreeWithLagrangesEquations) {
  this->ForEachKind([](const auto& batch, const auto& terms) {
    for (int lane = 0; lane < batch.num_lanes(); ++lane) {
      const support::LagrangeTerms oracle = batch.Oracle(lane);
      EXPECT_TRUE(IsClose(FullH(terms, lane), oracle.H, kDirect));
      EXPECT_TRUE(
          IsClose(LaneOf(terms.bias, lane), oracle.C + oracle.G, kDirect));
      EXPECT_TRUE(
          IsClose(LaneOf(terms.J, lane).transpose(), oracle.J, kDirect));
      EXPECT_TRUE(IsClose(LaneOf(terms.Jd_qd, lane), oracle.Jd_qd, kDirect));
    }
  });
}

TYPED_TEST(ChainTermsTest, CarryTheMemberWhereTheTransformsDo) {
  this->ForEachKind([](const auto& batch, const auto& terms) {
    for (int lane = 0; lane < batch.num_lanes(); ++lane) {
      const Eigen::VectorXd zero = Eigen::VectorXd::Zero(batch.q[lane].size());
      const support::CarriedMember member = support::CalcCarriedMember(
          batch.chains[lane], batch.q[lane], batch.qd[lane], zero);
      EXPECT_TRUE(IsClose(LaneOf(terms.P, lane), member.P, kDirect));
      EXPECT_TRUE(
          IsClose(LaneOf(terms.velocity, lane), member.velocity, kDirect));
      const auto constants = batch.Constants();
      const Eigen::Matrix3d R =
          LaneOf(terms.R.back(), lane) * LaneOf(constants.R_member, lane);
      EXPECT_TRUE(IsClose(R, member.R, kDirect));
    }
  });
}

TYPED_TEST(ChainTermsTest, GravityIsInTheBiasAndNotInJdQd) {
  support::Random random(2);
  Batch<TypeParam> batch(7, 2, &random);
  const auto with = CalcTerms(batch);
  const Eigen::Vector3d gravity = batch.gravity;
  batch.gravity.setZero();
  const auto without = CalcTerms(batch);
  for (int lane = 0; lane < batch.num_lanes(); ++lane) {
    const support::LagrangeTerms oracle = support::CalcLagrangeTerms(
        batch.chains[lane], batch.q[lane], batch.qd[lane], gravity);
    EXPECT_TRUE(IsClose(LaneOf(with.bias, lane) - LaneOf(without.bias, lane),
                        oracle.G, kDirect));
    EXPECT_TRUE(IsClose(LaneOf(with.Jd_qd, lane), LaneOf(without.Jd_qd, lane),
                        kDirect, gravity.norm()));
  }
}

TYPED_TEST(ChainTermsTest, AtRestHaveNoVelocityProducts) {
  support::Random random(3);
  Batch<TypeParam> batch(6, 2, &random);
  for (Eigen::VectorXd& qd : batch.qd) qd.setZero();
  const auto terms = CalcTerms(batch);
  for (int lane = 0; lane < batch.num_lanes(); ++lane) {
    const double g = batch.gravity.norm();
    EXPECT_TRUE(IsClose(LaneOf(terms.Jd_qd, lane), Vector6<double>::Zero(),
                        kDirect, g));
    EXPECT_TRUE(
        IsClose(LaneOf(terms.bias, lane), batch.Oracle(lane).G, kDirect));
  }
}

TEST(ChainTerms, LaneDoesNotDependOnItsNeighboursBitForBit) {
  support::Random random(4);
  const Batch<Pack<4>> batch(7, 2, &random);
  const auto together = CalcTerms(batch);
  for (int lane = 0; lane < 4; ++lane) {
    // The other lanes: the neighbour's chain, in a state that is NaN.
    Batch<Pack<4>> other = batch;
    for (int l = 0; l < 4; ++l) {
      if (l == lane) continue;
      other.chains[l] = batch.chains[(l + 1) % 4];
      other.q[l].setConstant(std::numeric_limits<double>::quiet_NaN());
    }
    const auto apart = CalcTerms(other);
    EXPECT_TRUE(HasSameBits(FullH(together, lane), FullH(apart, lane)));
    EXPECT_TRUE(
        HasSameBits(LaneOf(together.bias, lane), LaneOf(apart.bias, lane)));
    EXPECT_TRUE(HasSameBits(LaneOf(together.J, lane), LaneOf(apart.J, lane)));
    EXPECT_TRUE(
        HasSameBits(LaneOf(together.Jd_qd, lane), LaneOf(apart.Jd_qd, lane)));
    EXPECT_TRUE(HasSameBits(LaneOf(together.P, lane), LaneOf(apart.P, lane)));
  }
}

TEST(MakeChainConstants, FillsLanesLeftOverWithTheLastChain) {
  support::Random random(5);
  const Batch<Pack<4>> batch(6, 1, &random);
  const auto constants = MakeChainConstants<Pack<4>>(
      {&batch.chains[0], &batch.chains[1]}, batch.gravity);
  for (std::size_t i = 0; i < constants.joints.size(); ++i) {
    const auto& joint = constants.joints[i];
    for (int lane = 0; lane < 4; ++lane) {
      const Link& link = batch.chains[lane >= 1].arm.links[i];
      EXPECT_EQ(Lane(joint.mass, lane), link.mass);
      EXPECT_EQ(LaneOf(joint.inertia, lane), link.inertia);
    }
  }
}

TEST(SameJointTypes, ComparesNumberAndOrder) {
  support::Random random(6);
  const ArmModel arm = support::RandomArm(6, 0, &random);
  EXPECT_TRUE(SameJointTypes(arm, support::RandomArm(6, 0, &random)));
  EXPECT_FALSE(SameJointTypes(arm, support::RandomArm(7, 0, &random)));
  ArmModel first = arm, last = arm;
  first.links.front().type = JointType::kPrismatic;
  last.links.back().type = JointType::kPrismatic;
  EXPECT_FALSE(SameJointTypes(arm, first));
  EXPECT_FALSE(SameJointTypes(last, first));
  EXPECT_TRUE(SameJointTypes(first, first));
}

}  // namespace
}  // namespace dynamics
