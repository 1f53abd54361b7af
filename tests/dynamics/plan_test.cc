#include "dynamics/plan.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "dynamics/kinematics.h"
#include "dynamics/lift.h"
#include "tests/dynamics/support.h"

namespace dynamics {
namespace {

constexpr int kNumSteps = 50;
constexpr double kStep = 1.0 / kNumSteps;

TEST(StraightLift, IsAtRestAtItsEndsBeforeAndAfter) {
  const Eigen::Vector3d start(1, 2, 3), end(4, 5, 7);
  const LoadMotion motion = StraightLift(start, end, 2);
  for (const double t : {-1.0, 0.0, 2.0, 3.0}) {
    const MemberMotion at = motion(t);
    const Eigen::Vector3d expected = t <= 0 ? start : end;
    EXPECT_TRUE(IsClose(at.pose.translation(), expected, kDirect));
    EXPECT_EQ(at.pose.linear(), Eigen::Matrix3d::Identity());
    EXPECT_EQ(at.velocity, Vector6<double>::Zero());
    EXPECT_EQ(at.acceleration, Vector6<double>::Zero());
  }
}

TEST(StraightLift, IsHalfwayAtHalfTimeAndFastestThere) {
  const MemberMotion at = StraightLift({0, 0, 0}, {0, 0, 0.8}, 2)(1);
  EXPECT_NEAR(at.pose.translation()[2], 0.4, kDirect);
  EXPECT_NEAR(at.velocity[5], 0.8 * 30.0 / 16 / 2, kDirect);
  EXPECT_NEAR(at.acceleration[5], 0, kDirect);
}

TEST(StraightLift, VelocityAndAccelerationAreItsDerivatives) {
  const LoadMotion motion = StraightLift({1, 0, 0}, {0, 3, 1}, 2);
  constexpr double h = 1e-5;  // error h^2, and rounding 1e-16 / h
  for (double t = 0.1; t < 2; t += 0.3) {
    const MemberMotion at = motion(t), before = motion(t - h),
                       after = motion(t + h);
    EXPECT_TRUE(IsClose(
        at.velocity.tail<3>(),
        (after.pose.translation() - before.pose.translation()) / (2 * h),
        1e-8));
    EXPECT_TRUE(IsClose(at.acceleration.tail<3>(),
                        (after.velocity - before.velocity).tail<3>() / (2 * h),
                        1e-8, 1));
  }
}

class LiftPlan : public testing::Test {
 protected:
  const Lift lift_ = PumaLift();
  const Plan plan_ =
      MakePlan(lift_.model, lift_.motion, kStep, kNumSteps, lift_.q_guess);
};

TEST_F(LiftPlan, StartsAtTheJointPositionsOfTheExperiment) {
  ASSERT_EQ(plan_.num_times(), kNumSteps + 1);
  const double q[] = {0.3047974842, -0.4189813149, -2.4835986831,
                      0.3131513520, 1.3429999007,  -0.0729955860};
  for (int k = 0; k < 4; ++k) {
    for (int i = 0; i < 6; ++i) {
      EXPECT_NEAR(plan_.states[k](i, 0), q[i], 1e-9);  // ten printed digits
      EXPECT_NEAR(plan_.states[k](6 + i, 0), 0, kDirect);
    }
  }
}

// The forces are known only through the closed chain: without redundancy they
// follow from the torques.
TEST_F(LiftPlan, TorquesProduceThePlannedAccelerationsAndForces) {
  for (const Lanes lanes : {Lanes::kOne, Lanes::kFour}) {
    const TorqueTable torques(kStep, plan_.tau);
    const ClosedChainSystem system(lift_.model, torques, lanes);
    for (int n = 0; n <= kNumSteps; n += 5) {
      std::vector<Eigen::VectorXd> states;
      for (int k = 0; k < 4; ++k) states.push_back(plan_.states[k].col(n));
      const auto result = CalcClosedChainAccelerations(
          system, n * kStep, states, UnpackMember(plan_.member.col(n).data()));
      constexpr double g = 9.81;
      EXPECT_TRUE(IsClose(result.a_r, lift_.motion(n * kStep).acceleration,
                          kInverted, g));
      for (int k = 0; k < 4; ++k) {
        const double open = OpenAcceleration(
            lift_.model.chains[k], states[k].head(6), states[k].tail(6),
            plan_.tau[k].col(n), lift_.model.gravity);
        EXPECT_TRUE(IsClose(result.qdd[k], plan_.rates[k].col(n).tail(6),
                            kDirect, open));
        EXPECT_TRUE(IsClose(result.f[k], plan_.f[k].col(n), kInverted));
      }
    }
  }
}

TEST_F(LiftPlan, ChainsShareTheLoadEqually) {
  for (int n = 0; n <= kNumSteps; ++n) {
    Vector6<double> share = Vector6<double>::Zero();
    share[5] =
        4 * (lift_.motion(n * kStep).acceleration[5] + 9.81) / 4;  // 4 kg
    for (int k = 0; k < 4; ++k) {
      EXPECT_TRUE(IsClose(plan_.f[k].col(n), share, kDirect));
    }
  }
}

TEST_F(LiftPlan, CarriesTheMemberAlongTheMotion) {
  for (int n = 0; n <= kNumSteps; ++n) {
    const MemberMotion at = lift_.motion(n * kStep);
    const auto member = UnpackMember(plan_.member.col(n).data());
    EXPECT_EQ(member.p, at.pose.translation());
    EXPECT_EQ(member.v, at.velocity.tail<3>());
    for (int k = 0; k < 4; ++k) {
      const support::CarriedMember carried = support::CalcCarriedMember(
          lift_.model.chains[k], plan_.states[k].col(n).head(6),
          plan_.rates[k].col(n).head(6), plan_.rates[k].col(n).tail(6));
      EXPECT_TRUE(IsClose(carried.P, at.pose.translation(), kDirect));
      EXPECT_TRUE(IsClose(carried.R, at.pose.linear(), kDirect));
      EXPECT_TRUE(IsClose(carried.velocity, at.velocity, kDirect, 1));
      EXPECT_TRUE(IsClose(carried.acceleration, at.acceleration, kDirect, 10));
    }
  }
}

TEST_F(LiftPlan, RatesAreThoseOfItsStates) {
  for (int n = 0; n <= kNumSteps; ++n) {
    for (int k = 0; k < 4; ++k) {
      EXPECT_EQ(plan_.rates[k].col(n).head(6), plan_.states[k].col(n).tail(6));
    }
    const auto member = UnpackMember(plan_.member.col(n).data());
    const auto rate = UnpackMember(plan_.member_rate.col(n).data());
    EXPECT_EQ(rate.p, member.v);
    EXPECT_EQ(rate.v, lift_.motion(n * kStep).acceleration.tail<3>());
  }
}

// Around a circle, turning, so that every term of the motion is in use; a chain
// of seven joints, which holds one.
TEST(MakePlan, HoldsTheSurplusJointAndStillProducesTheMotion) {
  const LoadMotion motion = [](double t) {
    MemberMotion at;
    at.pose = Eigen::AngleAxisd(0.2 * t, Eigen::Vector3d::UnitY());
    at.pose.translation() =
        Eigen::Vector3d(0.05 * std::cos(t), 0.05 * std::sin(t), 0.02 * t);
    at.velocity << 0, 0.2, 0, -0.05 * std::sin(t), 0.05 * std::cos(t), 0.02;
    at.acceleration << 0, 0, 0, -0.05 * std::cos(t), -0.05 * std::sin(t), 0;
    return at;
  };
  support::Random random(1);
  SystemModel model;
  model.member = {.mass = 3, .inertia = random.Inertia()};
  std::vector<Eigen::VectorXd> q(2);
  for (int k = 0; k < 2; ++k) {
    model.chains.push_back(
        support::RandomChainHolding(motion(0).pose, 6 + k, 1, &random, &q[k]));
  }
  const Plan plan = MakePlan(model, motion, 0.01, 10, q);
  const auto carrying = ChooseCarryingJoints(model.chains[1], q[1], "chain 1");
  int num_held = 0;
  for (int i = 0; i < 7; ++i) {
    if (std::count(carrying.begin(), carrying.end(), i)) continue;
    ++num_held;
    for (int n = 0; n <= 10; ++n) {
      EXPECT_EQ(plan.states[1](i, n), q[1][i]);
      EXPECT_EQ(plan.states[1](7 + i, n), 0);
      EXPECT_EQ(plan.rates[1](7 + i, n), 0);
    }
  }
  EXPECT_EQ(num_held, 1);

  const TorqueTable torques(0.01, plan.tau);
  const ClosedChainSystem system(model, torques, Lanes::kOne);
  for (int n = 0; n <= 10; ++n) {
    const auto result = CalcClosedChainAccelerations(
        system, n * 0.01, {plan.states[0].col(n), plan.states[1].col(n)},
        UnpackMember(plan.member.col(n).data()));
    EXPECT_TRUE(
        IsClose(result.a_r, motion(n * 0.01).acceleration, kInverted, 10));
    for (int k = 0; k < 2; ++k) {
      EXPECT_TRUE(IsClose(result.qdd[k], plan.rates[k].col(n).tail(6 + k),
                          kInverted, 10));
      EXPECT_TRUE(IsClose(result.f[k], plan.f[k].col(n), kInverted));
    }
  }
}

// What MakePlan says of the experiment's arms with another motion.
std::string Complaint(const LoadMotion& motion,
                      const std::vector<Eigen::VectorXd>& q_guess) {
  return MessageOf<std::runtime_error>([&] {
    (void)MakePlan(PumaLift().model, motion, kStep, kNumSteps, q_guess);
  });
}

TEST(MakePlan, NamesTheChainAndTheTimeOfAnUnreachableGrip) {
  const std::string complaint =
      Complaint(StraightLift({0, 0, -0.6}, {0, 0, 2}, 1), PumaLift().q_guess);
  EXPECT_EQ(complaint.rfind("chain 0 at t = 0.", 0), 0u) << complaint;
  EXPECT_TRUE(Contains(complaint, " s cannot reach its grip")) << complaint;
}

TEST(MakePlan, NamesTheChainAndTheTimeThatStartsAtASingularity) {
  std::vector<Eigen::VectorXd> q_guess = PumaLift().q_guess;
  q_guess[2][4] = 0;
  EXPECT_TRUE(Contains(Complaint(PumaLift().motion, q_guess),
                       "chain 2 at t = 0.000000 s is at a singularity"));
}

TEST(MakePlan, RejectsAStartOfAnotherSize) {
  std::vector<Eigen::VectorXd> q_guess = PumaLift().q_guess;
  q_guess[3].conservativeResize(5);
  const auto complaint = [&] {
    return MessageOf<std::invalid_argument>([&] {
      (void)MakePlan(PumaLift().model, PumaLift().motion, kStep, 1, q_guess);
    });
  };
  EXPECT_EQ(complaint(),
            "chain 3: expected 6 joint positions to start from, got 5");
  q_guess.pop_back();
  EXPECT_EQ(complaint(),
            "expected joint positions to start from for 4 chains, got 3");
}

}  // namespace
}  // namespace dynamics
