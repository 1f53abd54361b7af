// What runs in every evaluation allocates no memory.

#include <gtest/gtest.h>

#include <algorithm>

#include "dynamics/closed_chain.h"
#include "dynamics/kinematics.h"
#include "tests/dynamics/support.h"
#include "tests/support/allocation_counter.h"

namespace dynamics {
namespace {

template <typename Function>
long CountAllocations(const Function& function) {
  const long before = support::NumAllocations();
  function();
  return support::NumAllocations() - before;
}

// The counter can fail: it sees operator new, and malloc as Eigen calls it
// within dynamics.
TEST(NumAllocations, CountsThoseOfNewAndOfEigen) {
  EXPECT_GT(CountAllocations([] { std::vector<double> v(1000, 1.0); }), 0);
  EXPECT_GT(CountAllocations([] { Eigen::VectorXd::Ones(1000).eval(); }), 0);
  support::Random random(1);
  const Chain chain = support::RandomChain(6, 0, &random);
  const Eigen::VectorXd q = Eigen::VectorXd::Zero(6);
  EXPECT_GT(CountAllocations([&] { (void)CalcMemberPose(chain, q); }), 0);
}

template <typename S>
class NoAllocationTest : public testing::Test {};
TYPED_TEST_SUITE(NoAllocationTest, Scalars);

TYPED_TEST(NoAllocationTest, InOpenAndClosedChain) {
  support::Random random(2);
  for (const int n : {6, 9}) {
    const Batch<TypeParam> batch(n, 1, &random);
    const auto constants = batch.Constants();
    const auto q = Interleave<TypeParam>(batch.q);
    const auto qd = Interleave<TypeParam>(batch.qd);
    const auto tau = Interleave<TypeParam>(batch.tau);
    OpenChainWork<TypeParam> work(n);
    OpenChain<TypeParam> open(n);
    Vector6<TypeParam> f;
    VectorX<TypeParam> qdd(n);
    EXPECT_EQ(CountAllocations([&] {
                CalcChainTerms(constants, q.data(), qd.data(), &work.terms);
              }),
              0);
    EXPECT_EQ(CountAllocations([&] {
                CalcOpenChain(constants, q.data(), qd.data(), tau.data(), &work,
                              &open);
              }),
              0);
    EXPECT_EQ(CountAllocations(
                  [&] { CalcClosedChain(open, open.a_open, &f, qdd.data()); }),
              0);
  }
}

class EvaluatorAllocates : public testing::TestWithParam<Lanes> {};
INSTANTIATE_TEST_SUITE_P(Lanes, EvaluatorAllocates,
                         testing::Values(Lanes::kOne, Lanes::kFour),
                         [](const auto& lanes) {
                           return lanes.param == Lanes::kOne ? "One" : "Four";
                         });

TEST_P(EvaluatorAllocates, NothingInOcdRmaAndCcd) {
  constexpr int kNumPoints = 3;
  const auto random = support::MakeRandomSystem({6, 7, 6, 6}, 3);
  std::vector<Eigen::MatrixXd> profile;
  for (const Eigen::VectorXd& tau : random.tau) {
    profile.push_back(tau.replicate(1, 6));
  }
  const TorqueTable torques(0.1, profile);
  const ClosedChainSystem system(random.model, torques, GetParam());
  TipExchange exchange = system.MakeExchange(kNumPoints);
  Evaluator evaluator = system.MakeEvaluator(0, 4, 0, kNumPoints, &exchange);

  auto states = ChainStatesOf(random.state);
  auto rates = states;
  double y[kMemberStateSize], yd[kMemberStateSize];
  PackMember(MemberOf(random.state), y);
  std::vector<const double*> inputs;
  std::vector<double*> outputs;
  for (int pair = 0; pair < 4 * kNumPoints; ++pair) {
    inputs.push_back(states[pair % 4].data());
    outputs.push_back(rates[pair % 4].data());
  }
  const std::vector<const double*> member(kNumPoints, y);
  const std::vector<double*> member_rate(kNumPoints, yd);
  const std::vector<double> times = {0, 0.1, 0.25};  // on the grid and off it
  double a_r[6 * kNumPoints];
  int failures[kNumPoints];
  EXPECT_EQ(CountAllocations([&] { evaluator.Ocd(0, times, inputs); }), 0);
  EXPECT_EQ(CountAllocations(
                [&] { evaluator.Rma(0, member, member_rate, a_r, failures); }),
            0);
  EXPECT_EQ(CountAllocations([&] { evaluator.Ccd(a_r, outputs); }), 0);
  for (const int failure : failures) EXPECT_EQ(failure, 0);
}

}  // namespace
}  // namespace dynamics
