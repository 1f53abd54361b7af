// The shares of tasks: Evaluator and TipExchange of closed_chain_system.h.

#include <gtest/gtest.h>

#include <cstdint>
#include <exception>
#include <limits>
#include <stdexcept>

#include "dynamics/closed_chain_system.h"
#include "tests/dynamics/support.h"

namespace dynamics {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

class EvaluatorTest : public testing::TestWithParam<Lanes> {};
INSTANTIATE_TEST_SUITE_P(Lanes, EvaluatorTest,
                         testing::Values(Lanes::kOne, Lanes::kFour),
                         [](const auto& lanes) {
                           return lanes.param == Lanes::kOne ? "One" : "Four";
                         });

// Evaluates `num_points` states of one system in shares of the given size.
class Shares {
 public:
  Shares(const SystemModel& model, Lanes lanes, int num_points)
      : num_chains_(model.num_chains()),
        num_points_(num_points),
        function_([&model](int k, double t, const double* q, const double* qd,
                           double* tau) {
          const int n = model.chains[k].arm.num_joints();
          for (int i = 0; i < n; ++i) tau[i] = t + k - 3 * q[i] - qd[i];
        }),
        system_(model, function_, lanes) {}

  const ClosedChainSystem& system() const { return system_; }

  struct Result {
    std::vector<Eigen::VectorXd> rates;    // by point, then chain
    std::vector<Vector6<double>> f;        // the same
    std::vector<Eigen::VectorXd> members;  // by point
    std::vector<int> failures;             // by point
  };

  // `states` by point, then chain; `members` by point.
  Result Run(const std::vector<Eigen::VectorXd>& states,
             const std::vector<Eigen::VectorXd>& members, int chains_per_share,
             int points_per_share) const {
    Result result;
    for (const auto& state : states) {
      result.rates.emplace_back(state.size());
      result.f.emplace_back();
    }
    result.members.assign(members.size(), Eigen::VectorXd(kMemberStateSize));
    result.failures.resize(members.size());
    TipExchange exchange = system_.MakeExchange(num_points_);
    struct Share {
      int first_chain, chains, first_point, points;
      Evaluator evaluator;
    };
    std::vector<Share> shares;
    for (int k = 0; k < num_chains_; k += chains_per_share) {
      for (int i = 0; i < num_points_; i += points_per_share) {
        const int chains = std::min(chains_per_share, num_chains_ - k);
        const int points = std::min(points_per_share, num_points_ - i);
        shares.push_back(
            {k, chains, i, points,
             system_.MakeEvaluator(k, chains, i, points, &exchange)});
      }
    }
    for (Share& share : shares) {
      std::vector<double> times;
      std::vector<const double*> inputs;
      for (int i = 0; i < share.points; ++i) {
        times.push_back(0.1 * (share.first_point + i));
        for (int k = 0; k < share.chains; ++k) {
          inputs.push_back(
              states[Index(share.first_chain + k, share.first_point + i)]
                  .data());
        }
      }
      share.evaluator.Ocd(0, times, inputs);
    }
    for (Share& share : shares) {
      std::vector<const double*> inputs;
      std::vector<double*> member_rates, rates;
      for (int i = 0; i < share.points; ++i) {
        const int point = share.first_point + i;
        inputs.push_back(members[point].data());
        member_rates.push_back(result.members[point].data());
        for (int k = 0; k < share.chains; ++k) {
          rates.push_back(
              result.rates[Index(share.first_chain + k, point)].data());
        }
      }
      std::vector<double> a_r(6 * static_cast<std::size_t>(share.points));
      std::vector<int> failures(share.points, -7);
      share.evaluator.Rma(0, inputs, member_rates, a_r.data(), failures);
      for (int i = 0; i < share.points; ++i) {
        result.failures[share.first_point + i] = failures[i];
      }
      share.evaluator.Ccd(a_r.data(), rates);
      for (int i = 0; i < share.points; ++i) {
        for (int k = 0; k < share.chains; ++k) {
          result.f[Index(share.first_chain + k, share.first_point + i)] =
              share.evaluator.TipForce(i * share.chains + k);
        }
      }
    }
    return result;
  }

 private:
  std::size_t Index(int k, int point) const {
    return static_cast<std::size_t>(point * num_chains_ + k);
  }

  int num_chains_;
  int num_points_;
  TorqueFunction function_;
  ClosedChainSystem system_;
};

// States of `num_points` points, all different.
void MakePoints(const support::RandomSystem& random, int num_points,
                std::vector<Eigen::VectorXd>* states,
                std::vector<Eigen::VectorXd>* members) {
  for (int i = 0; i < num_points; ++i) {
    for (Eigen::VectorXd y : ChainStatesOf(random.state)) {
      y *= 1 + 0.01 * i;
      states->push_back(y);
    }
    members->emplace_back(kMemberStateSize);
    PackMember(MemberOf(random.state), members->back().data());
    members->back() *= 1 + 0.01 * i;
  }
}

void ExpectSame(const Shares::Result& a, const Shares::Result& b) {
  for (std::size_t i = 0; i < a.rates.size(); ++i) {
    EXPECT_TRUE(a.rates[i].allFinite());
    EXPECT_TRUE(a.f[i].allFinite());
    EXPECT_TRUE(HasSameBits(a.rates[i], b.rates[i])) << "pair " << i;
    EXPECT_TRUE(HasSameBits(a.f[i], b.f[i])) << "pair " << i;
  }
  for (std::size_t i = 0; i < a.members.size(); ++i) {
    EXPECT_TRUE(a.members[i].allFinite());
    EXPECT_TRUE(HasSameBits(a.members[i], b.members[i])) << "point " << i;
  }
}

// Packs of every filling, from one lane in use to all.
TEST_P(EvaluatorTest, EveryPartitionGivesTheSameBitsAndNoNan) {
  for (const auto& num_joints : std::vector<std::vector<int>>{
           {6}, {6, 6}, {6, 6, 6}, {6, 7, 6}, {6, 6, 6, 6, 6}}) {
    const int m = static_cast<int>(num_joints.size());
    auto random = support::MakeRandomSystem(num_joints, 7);
    for (const int num_points : {1, 2, 3, 5}) {
      const Shares shares(random.model, GetParam(), num_points);
      std::vector<Eigen::VectorXd> states, members;
      MakePoints(random, num_points, &states, &members);
      const auto alone = shares.Run(states, members, 1, 1);
      for (int chains = 1; chains <= m; ++chains) {
        for (int points = 1; points <= num_points; ++points) {
          SCOPED_TRACE(testing::Message()
                       << chains << " of " << m << " chains, " << points
                       << " of " << num_points << " points");
          const auto result = shares.Run(states, members, chains, points);
          for (const int failure : result.failures) EXPECT_EQ(failure, 0);
          ExpectSame(result, alone);
        }
      }
    }
  }
}

TEST_P(EvaluatorTest, NanStateSpoilsNoOtherPoint) {
  const auto random = support::MakeRandomSystem({6, 6, 6}, 8);
  const Shares shares(random.model, GetParam(), 3);
  std::vector<Eigen::VectorXd> states, members;
  MakePoints(random, 3, &states, &members);
  const auto sound = shares.Run(states, members, 3, 3);
  states[3 * 1 + 2][0] = kNan;  // chain 2 at point 1
  const auto together = shares.Run(states, members, 3, 3);
  EXPECT_EQ(together.failures, (std::vector<int>{0, -3, 0}));
  for (const int point : {0, 2}) {
    EXPECT_TRUE(HasSameBits(together.members[point], sound.members[point]));
    for (int k = 0; k < 3; ++k) {
      EXPECT_TRUE(HasSameBits(together.rates[3 * point + k],
                              sound.rates[3 * point + k]));
    }
  }
}

TEST_P(EvaluatorTest, SetsOfTheExchangeAreApart) {
  const auto first = support::MakeRandomSystem({6, 6}, 9);
  const ConstantTorques torques(first.tau);
  const ClosedChainSystem system(first.model, torques, GetParam());
  TipExchange exchange = system.MakeExchange(1);
  Evaluator evaluator = system.MakeEvaluator(0, 2, 0, 1, &exchange);
  const auto states = ChainStatesOf(first.state);
  double y[kMemberStateSize], yd[kMemberStateSize];
  PackMember(MemberOf(first.state), y);
  const double* member = y;
  double* member_rate = yd;
  const double t = 0;
  const std::vector<const double*> at = {states[0].data(), states[1].data()};
  auto faster = states;
  for (Eigen::VectorXd& state : faster) state *= 1.1;
  const std::vector<const double*> later = {faster[0].data(), faster[1].data()};

  const auto calc_a_r = [&](int set) {
    Vector6<double> a_r;
    int failure;
    evaluator.Rma(set, {&member, 1}, {&member_rate, 1}, a_r.data(),
                  {&failure, 1});
    EXPECT_EQ(failure, 0);
    return a_r;
  };
  evaluator.Ocd(0, {&t, 1}, at);
  const Vector6<double> before = calc_a_r(0);
  evaluator.Ocd(1, {&t, 1}, later);
  const Vector6<double> after = calc_a_r(0);
  const Vector6<double> other = calc_a_r(1);
  EXPECT_TRUE(HasSameBits(before, after));
  EXPECT_FALSE(HasSameBits(before, other));
}

TEST_P(EvaluatorTest, ExceptionOfTheTorqueFunctionDoesNotLeaveOcd) {
  const auto random = support::MakeRandomSystem({6}, 10);
  const TorqueFunction torques(
      [](int, double, const double*, const double*, double*) {
        throw std::runtime_error("no torques today");
      });
  const ClosedChainSystem system(random.model, torques, GetParam());
  TipExchange exchange = system.MakeExchange(1);
  Evaluator evaluator = system.MakeEvaluator(0, 1, 0, 1, &exchange);
  const auto states = ChainStatesOf(random.state);
  const double* state = states[0].data();
  const double t = 0;
  EXPECT_NO_THROW(evaluator.Ocd(0, {&t, 1}, {&state, 1}));
  double y[kMemberStateSize], yd[kMemberStateSize], a_r[6];
  PackMember(MemberOf(random.state), y);
  const double* member = y;
  double* member_rate = yd;
  int failure = 0;
  evaluator.Rma(0, {&member, 1}, {&member_rate, 1}, a_r, {&failure, 1});
  EXPECT_NE(failure, 0);
  const std::exception_ptr error = evaluator.TakeError();
  ASSERT_TRUE(error);
  EXPECT_THROW(std::rethrow_exception(error), std::runtime_error);
  EXPECT_FALSE(evaluator.TakeError());
}

TEST_P(EvaluatorTest, HasThePairsOfItsShareOnly) {
  const auto random = support::MakeRandomSystem({6, 6}, 13);
  const ConstantTorques torques(random.tau);
  const ClosedChainSystem system(random.model, torques, GetParam());
  TipExchange exchange = system.MakeExchange(1);
  const Evaluator evaluator = system.MakeEvaluator(0, 2, 0, 1, &exchange);
  EXPECT_THROW((void)evaluator.TipForce(2), std::out_of_range);
}

TEST(TipExchange, SlotsAreOnCacheLinesOfTheirOwn) {
  TipExchange exchange(2, 3);
  const auto address = [&](int set, int point, int k) {
    return reinterpret_cast<std::uintptr_t>(&exchange.slot(set, point, k));
  };
  std::vector<std::uintptr_t> all;
  for (int set = 0; set < 2; ++set) {
    for (int point = 0; point < 2; ++point) {
      for (int k = 0; k < 3; ++k) {
        EXPECT_EQ(address(set, point, k) % 64, 0u);
        for (const auto other : all) EXPECT_NE(other, address(set, point, k));
        all.push_back(address(set, point, k));
      }
    }
  }
}

}  // namespace
}  // namespace dynamics
