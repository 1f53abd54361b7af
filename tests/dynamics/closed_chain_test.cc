#include "dynamics/closed_chain.h"

#include <gtest/gtest.h>

#include "tests/dynamics/support.h"

namespace dynamics {
namespace {

template <typename S>
class ClosedChainTest : public testing::Test {
 protected:
  // For N = 6 ... 9: open chains, and their tips forced to accelerate with
  // a_r. Calls `check(batch, lane, open, a_r, f, qdd)` for every lane.
  template <typename Check>
  static void ForEachLane(bool tip_is_free, const Check& check) {
    support::Random random(1);
    for (int n = 6; n <= 9; ++n) {
      const Batch<S> batch(n, 2, &random);
      const VectorX<S> q = Interleave<S>(batch.q);
      const VectorX<S> qd = Interleave<S>(batch.qd);
      const VectorX<S> tau = Interleave<S>(batch.tau);
      OpenChainWork<S> work(n);
      OpenChain<S> open(n);
      CalcOpenChain(batch.Constants(), q.data(), qd.data(), tau.data(), &work,
                    &open);
      Vector6<S> a_r = open.a_open;
      if (!tip_is_free) {
        for (S& a : a_r) a = S(random.Uniform(-10, 10));
      }
      Vector6<S> f;
      VectorX<S> qdd(n);
      CalcClosedChain(open, a_r, &f, qdd.data());
      for (int lane = 0; lane < batch.num_lanes(); ++lane) {
        check(batch, lane, LaneOf(a_r, lane), LaneOf(f, lane),
              LaneOf(qdd, lane), LaneOf(open.qdd_open, lane),
              LaneOf(open.Lambda, lane));
      }
    }
  }
};
TYPED_TEST_SUITE(ClosedChainTest, Scalars);

TYPED_TEST(ClosedChainTest, TipAcceleratesAsTheMemberDoes) {
  this->ForEachLane(
      false, [](const auto& batch, int lane, const auto& a_r, const auto& /*f*/,
                const auto& qdd, const auto& qdd_open, const auto& /*Lambda*/) {
        const support::LagrangeTerms oracle = batch.Oracle(lane);
        EXPECT_TRUE(IsClose(oracle.J * qdd.template cast<support::Real>(),
                            a_r.template cast<support::Real>() - oracle.Jd_qd,
                            kInverted, qdd_open.cwiseAbs().maxCoeff()));
      });
}

TYPED_TEST(ClosedChainTest, TorquesBalanceWithTheForceOnTheMember) {
  this->ForEachLane(
      false,
      [](const auto& batch, int lane, const auto& /*a_r*/, const auto& f,
         const auto& qdd, const auto& /*qdd_open*/, const auto& /*Lambda*/) {
        using support::Real;
        const support::LagrangeTerms oracle = batch.Oracle(lane);
        const support::VectorXl JT_f =
            oracle.J.transpose() * f.template cast<Real>();
        EXPECT_TRUE(IsClose(
            oracle.H * qdd.template cast<Real>() + oracle.C + oracle.G + JT_f,
            batch.tau[lane], kInverted,
            static_cast<double>(JT_f.cwiseAbs().maxCoeff())));
      });
}

TYPED_TEST(ClosedChainTest, TipThatMovesFreelyExertsNoForce) {
  this->ForEachLane(true, [](const auto& /*batch*/, int /*lane*/,
                             const auto& a_r, const auto& f, const auto& qdd,
                             const auto& qdd_open, const auto& Lambda) {
    const double scale =
        Lambda.cwiseAbs().maxCoeff() * a_r.cwiseAbs().maxCoeff();
    EXPECT_TRUE(IsClose(f, Vector6<double>::Zero(), kDirect, scale));
    EXPECT_TRUE(IsClose(qdd, qdd_open, kInverted));
  });
}

}  // namespace
}  // namespace dynamics
