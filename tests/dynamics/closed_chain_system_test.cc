#include "dynamics/closed_chain_system.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "dynamics/lift.h"
#include "tests/dynamics/support.h"

namespace dynamics {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

// Numbers of joints: 1 ... 6 chains, six to nine joints, mixed.
const std::vector<std::vector<int>> kSystems = {
    {6},
    {7},
    {9},
    {6, 6},
    {6, 7, 8},
    {9, 8, 7, 6},
    {6, 6, 6, 6},
    {6, 6, 7, 6, 6},
    {7, 6, 8, 6, 9, 6},
};

ClosedChainAccelerations Calc(const support::RandomSystem& random,
                              Lanes lanes) {
  const ConstantTorques torques(random.tau);
  const ClosedChainSystem system(random.model, torques, lanes);
  return CalcClosedChainAccelerations(system, 0, ChainStatesOf(random.state),
                                      MemberOf(random.state));
}

class ClosedChainSystemTest : public testing::TestWithParam<Lanes> {
 protected:
  // Calls `check(random, accelerations)` for all systems.
  template <typename Check>
  static void ForEachSystem(const Check& check) {
    for (std::size_t i = 0; i < kSystems.size(); ++i) {
      SCOPED_TRACE(testing::Message() << "system " << i);
      const auto random = support::MakeRandomSystem(kSystems[i], 100 + i);
      check(random, Calc(random, GetParam()));
    }
  }
};
INSTANTIATE_TEST_SUITE_P(Lanes, ClosedChainSystemTest,
                         testing::Values(Lanes::kOne, Lanes::kFour),
                         [](const auto& lanes) {
                           return lanes.param == Lanes::kOne ? "One" : "Four";
                         });

TEST_P(ClosedChainSystemTest, AgreesWithTheDenseSystemOfAllEquations) {
  ForEachSystem([](const auto& random, const auto& result) {
    const support::KktSolution kkt =
        support::SolveKkt(random.model, random.state, random.tau);
    EXPECT_TRUE(IsClose(result.a_r, kkt.a_r, kInverted));
    for (int k = 0; k < random.model.num_chains(); ++k) {
      EXPECT_TRUE(IsClose(result.f[k], kkt.f[k], kInverted));
      EXPECT_TRUE(IsClose(result.qdd[k], kkt.qdd[k], kInverted));
    }
  });
}

TEST_P(ClosedChainSystemTest, OfPumasAgreesWithTheDenseSystem) {
  support::Random random(1);
  const Lift lift = PumaLift();
  const Plan plan = MakePlan(lift.model, lift.motion, 0.05, 20, lift.q_guess);
  for (int n = 0; n <= 20; n += 4) {
    support::RandomSystem system;
    system.model = lift.model;
    for (int k = 0; k < 4; ++k) {
      system.state.q.push_back(plan.states[k].col(n).head(6));
      system.state.qd.push_back(plan.states[k].col(n).tail(6));
      // Up to 5 % off the plan: torques that fight each other would leave the
      // accelerations as small differences of large ones.
      system.tau.push_back(plan.tau[k].col(n).cwiseProduct(
          Eigen::VectorXd::Ones(6) + random.Vector(6, 0.05)));
    }
    const MemberState<double> member = UnpackMember(plan.member.col(n).data());
    system.state.Q = {member.Q[0], member.Q[1], member.Q[2], member.Q[3]};
    system.state.p = member.p;
    system.state.omega = member.omega;
    system.state.v = member.v;
    const support::KktSolution kkt =
        support::SolveKkt(system.model, system.state, system.tau);
    const ClosedChainAccelerations result = Calc(system, GetParam());
    EXPECT_TRUE(IsClose(result.a_r, kkt.a_r, kInverted));
    for (int k = 0; k < 4; ++k) {
      EXPECT_TRUE(IsClose(result.f[k], kkt.f[k], kInverted));
      EXPECT_TRUE(
          IsClose(result.qdd[k], kkt.qdd[k], kDirect,
                  OpenAcceleration(system.model.chains[k], system.state.q[k],
                                   system.state.qd[k], system.tau[k],
                                   system.model.gravity)));
    }
  }
}

TEST_P(ClosedChainSystemTest, TipForcesSumToWhatTheMemberNeeds) {
  ForEachSystem([](const auto& random, const auto& result) {
    Vector6<double> sum = Vector6<double>::Zero();
    double largest = 0;
    for (const Vector6<double>& f : result.f) {
      sum += f;
      largest = std::max(largest, f.cwiseAbs().maxCoeff());
    }
    const support::MemberTerms member =
        support::CalcMemberTerms(random.model, random.state);
    EXPECT_TRUE(IsClose(sum,
                        member.I_r * result.a_r.template cast<support::Real>() +
                            member.b_minus_g,
                        kInverted, largest));
  });
}

// The rate of momentum by a central difference along the member's rate of
// change, which knows of neither I_r a_r + b_r nor of frames.
TEST_P(ClosedChainSystemTest, TipForcesAndWeightChangeTheMomentumOfTheMember) {
  ForEachSystem([](const auto& random, const auto& result) {
    const MemberState<double> y = MemberOf(random.state);
    const MemberState<double> rate = MemberDerivative(y, result.a_r);
    const auto momentum = [&](double h) {
      std::array<double, 4> Q = y.Q;
      for (int i = 0; i < 4; ++i) Q[i] += h * rate.Q[i];
      const Eigen::Matrix3d R = MemberAxes(Q);
      Vector6<double> p;
      p << R * random.model.member.inertia * R.transpose() *
               (y.omega + h * rate.omega),
          random.model.member.mass * (y.v + h * rate.v);
      return p;
    };
    Vector6<double> force = Vector6<double>::Zero();
    force.tail<3>() = random.model.member.mass * random.model.gravity;
    for (const Vector6<double>& f : result.f) force += f;
    constexpr double h = 1e-5;  // error h^2, and rounding 1e-16 / h
    EXPECT_TRUE(IsClose((momentum(h) - momentum(-h)) / (2 * h), force, 1e-8));
  });
}

TEST_P(ClosedChainSystemTest, EnergyGrowsByThePowerOfTheJoints) {
  ForEachSystem([](const auto& random, const auto& result) {
    const support::SystemState& state = random.state;
    const support::MemberTerms member =
        support::CalcMemberTerms(random.model, state);
    // Of the member: (I_r a_r + b_r - g_r) . velocity.
    support::Vector6l velocity;
    velocity << state.omega.template cast<support::Real>(),
        state.v.template cast<support::Real>();
    support::Real rate =
        velocity.dot(member.I_r * result.a_r.template cast<support::Real>() +
                     member.b_minus_g);
    support::Real power = 0, largest = std::abs(rate);
    for (int k = 0; k < random.model.num_chains(); ++k) {
      const support::Real rate_k = support::CalcEnergyRate(
          random.model.chains[k], state.q[k], state.qd[k], result.qdd[k],
          random.model.gravity);
      rate += rate_k;
      power += random.tau[k].dot(state.qd[k]);
      largest = std::max(largest, std::abs(rate_k));
    }
    EXPECT_LT(std::abs(rate - power), kInverted * largest);
  });
}

TEST_P(ClosedChainSystemTest, EveryTipAcceleratesAsTheMemberDoes) {
  ForEachSystem([](const auto& random, const auto& result) {
    for (int k = 0; k < random.model.num_chains(); ++k) {
      const support::CarriedMember tip =
          support::CalcCarriedMember(random.model.chains[k], random.state.q[k],
                                     random.state.qd[k], result.qdd[k]);
      EXPECT_TRUE(IsClose(tip.acceleration, result.a_r, kInverted,
                          result.qdd[k].cwiseAbs().maxCoeff()));
    }
  });
}

TEST_P(ClosedChainSystemTest, ReportsTheTorquesItUsed) {
  ForEachSystem([](const auto& random, const auto& result) {
    for (int k = 0; k < random.model.num_chains(); ++k) {
      EXPECT_EQ(result.tau[k], random.tau[k]);
    }
  });
}

TEST_P(ClosedChainSystemTest, HandsTimeAndStateToTheTorqueSource) {
  const auto random = support::MakeRandomSystem({6, 7}, 1);
  int num_calls = 0;
  const TorqueFunction torques(
      [&](int k, double t, const double* q, const double* qd, double* tau) {
        EXPECT_EQ(t, 0.125);
        for (int i = 0; i < random.state.q[k].size(); ++i) {
          EXPECT_EQ(q[i], random.state.q[k][i]);
          EXPECT_EQ(qd[i], random.state.qd[k][i]);
          tau[i] = 0;
        }
        ++num_calls;
      });
  const ClosedChainSystem system(random.model, torques, GetParam());
  (void)CalcClosedChainAccelerations(system, 0.125, ChainStatesOf(random.state),
                                     MemberOf(random.state));
  EXPECT_EQ(num_calls, 2);
}

// What CalcClosedChainAccelerations says of a system at t = 0.25 s.
std::string Complaint(const support::RandomSystem& random,
                      const TorqueSource& torques, Lanes lanes) {
  const ClosedChainSystem system(random.model, torques, lanes);
  return MessageOf<std::runtime_error>([&] {
    (void)CalcClosedChainAccelerations(
        system, 0.25, ChainStatesOf(random.state), MemberOf(random.state));
  });
}

TEST_P(ClosedChainSystemTest, ExceptionOfTheTorqueFunctionReachesTheCaller) {
  const auto random = support::MakeRandomSystem({6, 6}, 10);
  const TorqueFunction torques(
      [](int k, double, const double*, const double*, double* tau) {
        if (k == 1) throw std::runtime_error("no torques today");
        std::fill(tau, tau + 6, 0.0);
      });
  EXPECT_EQ(Complaint(random, torques, GetParam()), "no torques today");
}

TEST_P(ClosedChainSystemTest, NanTorqueIsAFailure) {
  const auto random = support::MakeRandomSystem({6, 6}, 11);
  const TorqueFunction torques(
      [](int k, double, const double*, const double*, double* tau) {
        std::fill(tau, tau + 6, 1.0);
        if (k == 1) tau[3] = kNan;
      });
  EXPECT_TRUE(
      Contains(Complaint(random, torques, GetParam()), " at t = 0.250000 s"));
}

TEST_P(ClosedChainSystemTest, NamesTheSingularChainAndTheTime) {
  support::RandomSystem random;
  random.model = PumaLift(3).model;
  for (int k = 0; k < 3; ++k) {
    Eigen::VectorXd q(6);
    q << 0.3, -0.4, -2.5, 0.3, k == 1 ? 0.0 : 1.3, 0.2;  // 1: wrist straight
    random.state.q.push_back(q);
    random.state.qd.push_back(Eigen::VectorXd::Zero(6));
    random.tau.push_back(Eigen::VectorXd::Zero(6));
  }
  random.state.Q = Eigen::Quaterniond::Identity();
  random.state.p = random.state.omega = random.state.v =
      Eigen::Vector3d::Zero();
  const ConstantTorques torques(random.tau);
  EXPECT_EQ(Complaint(random, torques, GetParam()),
            "chain 1 is at a singularity (Lambda^-1 is not invertible) at t = "
            "0.250000 s");
}

TEST_P(ClosedChainSystemTest, NamesTheChainWithFewerThanSixJoints) {
  auto random = support::MakeRandomSystem({6, 6}, 12);
  random.model.chains[1].arm.links.pop_back();
  random.state.q[1].conservativeResize(5);
  random.state.qd[1].conservativeResize(5);
  random.tau[1].conservativeResize(5);
  const ConstantTorques torques(random.tau);
  EXPECT_TRUE(Contains(Complaint(random, torques, GetParam()),
                       "chain 1 has 5 joints: it cannot hold"));
}

TEST_P(ClosedChainSystemTest, RejectsABadModel) {
  const ConstantTorques torques({});
  EXPECT_THROW(ClosedChainSystem({}, torques, GetParam()),
               std::invalid_argument);
}

TEST(ClosedChainSystem, SizesAreThoseOfTheStateVectors) {
  const auto random = support::MakeRandomSystem({6, 9}, 14);
  const ConstantTorques torques(random.tau);
  const ClosedChainSystem system(random.model, torques, Lanes::kOne);
  EXPECT_EQ(system.num_chains(), 2);
  EXPECT_EQ(system.chain_size(0), 12);
  EXPECT_EQ(system.chain_size(1), 18);
  EXPECT_EQ(system.common_size(), 13);
  EXPECT_EQ(system.coupling_size(), 6);
}

TEST(PackMember, WritesQuaternionPositionOmegaVelocityInThisOrder) {
  const MemberState<double> state = {.Q = {1, 2, 3, 4},
                                     .p = {5, 6, 7},
                                     .omega = {8, 9, 10},
                                     .v = {11, 12, 13}};
  double y[kMemberStateSize];
  PackMember(state, y);
  for (int i = 0; i < kMemberStateSize; ++i) EXPECT_EQ(y[i], i + 1);
  double again[kMemberStateSize];
  PackMember(UnpackMember(y), again);
  for (int i = 0; i < kMemberStateSize; ++i) EXPECT_EQ(again[i], i + 1);
}

}  // namespace
}  // namespace dynamics
