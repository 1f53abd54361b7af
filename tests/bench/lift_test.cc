// The paper's system through the paper's integrators: dynamics and integrators
// together.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

#include "bench/lift_case.h"
#include "dynamics/kinematics.h"

namespace bench {
namespace {

using dynamics::ClosedChainSystem;
using dynamics::Lanes;
using integrators::BlockMethod;
using integrators::Figure;
using integrators::Integration;
using integrators::IntegrationOptions;
using integrators::Partition;
using macrotask::WaitPolicy;

bool SameBits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() &&
         std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

std::vector<BlockMethod> Methods() {
  return {integrators::B1PC5(), integrators::B2PC5(), integrators::B4PC5()};
}

class LiftLanes : public testing::TestWithParam<Lanes> {};

TEST_P(LiftLanes, EveryPartitionAndWayToWaitGivesTheSerialStatesBitForBit) {
  const LiftCase lift(dynamics::PumaLift(), 30);
  const ClosedChainSystem system(lift.lift().model, lift.torques(), GetParam());
  for (const BlockMethod& method : Methods()) {
    const auto run = [&](Figure figure, Partition partition, WaitPolicy wait) {
      Integration integration(system, {.method = method,
                                       .step = lift.step(),
                                       .num_steps = lift.num_steps(),
                                       .figure = figure,
                                       .partition = partition,
                                       .wait = wait});
      return integration.Run(lift.InitialState()).state;
    };
    const std::vector<double> serial = run(Figure::kSerial, {}, {});
    for (const WaitPolicy wait :
         {WaitPolicy::Block(), WaitPolicy::Spin(), WaitPolicy::Hold()}) {
      for (int m = 1; m <= 4; ++m) {
        EXPECT_TRUE(SameBits(run(Figure::kFigure2, {m, 1}, wait), serial));
        EXPECT_TRUE(SameBits(run(Figure::kFigure3, {m, 1}, wait), serial));
        for (int p = 1; p <= method.block_size; ++p) {
          EXPECT_TRUE(SameBits(run(Figure::kFigure8, {m, p}, wait), serial))
              << method.name() << " " << m << " x " << p;
        }
      }
      for (int p = 1; p <= method.block_size; ++p) {
        EXPECT_TRUE(SameBits(run(Figure::kFigure7, {1, p}, wait), serial));
      }
    }
  }
}

TEST_P(LiftLanes, FollowsThePlanAndKeepsTheGrips) {
  const LiftCase lift(dynamics::PumaLift(), 128);
  const ClosedChainSystem system(lift.lift().model, lift.torques(), GetParam());
  for (const BlockMethod& method : Methods()) {
    Integration integration(
        system,
        {.method = method, .step = lift.step(), .num_steps = lift.num_steps()});
    const auto state = integration.Run(lift.InitialState()).state;
    EXPECT_LT(lift.Error(state), 1e-6) << method.name();
    const auto member = lift.Member(state);
    for (int k = 0; k < 4; ++k) {
      const Eigen::VectorXd q =
          Eigen::Map<const Eigen::VectorXd>(state.data() + 12 * k, 6);
      const Eigen::Isometry3d carried = dynamics::CalcMemberPose(
          lift.lift().model.chains[static_cast<std::size_t>(k)], q);
      EXPECT_LT((carried.translation() - member.p).norm(), 1e-6);
      EXPECT_LT((carried.linear() - dynamics::MemberAxes(member.Q)).norm(),
                1e-5);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Widths, LiftLanes,
                         testing::Values(Lanes::kOne, Lanes::kFour),
                         [](const auto& instance) {
                           return std::to_string(
                               static_cast<int>(instance.param));
                         });

TEST(Lift, WidthsOfLanesAgreeToRounding) {
  const LiftCase lift(dynamics::PumaLift(), 64);
  std::vector<double> states[2];
  for (const Lanes lanes : {Lanes::kOne, Lanes::kFour}) {
    const ClosedChainSystem system(lift.lift().model, lift.torques(), lanes);
    Integration integration(
        system, {.step = lift.step(), .num_steps = lift.num_steps()});
    states[lanes == Lanes::kFour] = integration.Run(lift.InitialState()).state;
  }
  for (std::size_t e = 0; e < states[0].size(); ++e) {
    // cond(J H^-1 J^T) is 2e5, and the closed chains amplify drift.
    EXPECT_NEAR(states[0][e], states[1][e], 1e-8);
  }
}

// A load that turns while it is lifted: the error of the orientation falls like
// that of the rest.
TEST(Lift, OrientationKeepsTheOrder) {
  const auto error = [](int num_steps) {
    dynamics::Lift turning = dynamics::PumaLift();
    const auto straight = turning.motion;
    const Eigen::Vector3d axis = Eigen::Vector3d(1, 2, 3).normalized();
    turning.motion = [straight, axis](double t) {
      dynamics::MemberMotion motion = straight(t);
      // The way and its derivatives, read off the straight lift.
      const double way = (motion.pose.translation().z() + 0.6) / 0.8;
      constexpr double kTurn = 0.2;  // rad
      motion.pose.linear() =
          Eigen::AngleAxisd(kTurn * way, axis).toRotationMatrix();
      motion.velocity.head<3>() = kTurn * motion.velocity[5] / 0.8 * axis;
      motion.acceleration.head<3>() =
          kTurn * motion.acceleration[5] / 0.8 * axis;
      return motion;
    };
    const Eigen::Matrix3d end = turning.motion(1).pose.linear();
    const LiftCase lift(std::move(turning), num_steps);
    const ClosedChainSystem system(lift.lift().model, lift.torques(),
                                   Lanes::kFour);
    Integration integration(system, {.method = integrators::B4PC5(),
                                     .step = lift.step(),
                                     .num_steps = num_steps});
    const auto state = integration.RunFrom(lift.Planned()).state;
    return (dynamics::MemberAxes(lift.Member(state).Q) - end).norm();
  };
  const double coarse = error(64), fine = error(256);
  EXPECT_GT(std::log2(coarse / fine) / 2, 4.5) << coarse << " " << fine;
  EXPECT_LT(fine, 1e-6);
}

// Computed torques with feedback hold the arms on the plan: torques as a
// function of time and state, in every figure.
TEST(Lift, ControllerBringsTheLoadToItsEnd) {
  const LiftCase lift(dynamics::PumaLift(), 100);
  const LiftCase fine(dynamics::PumaLift(), 400);
  const dynamics::Plan plan =
      dynamics::MakePlan(lift.lift().model, lift.lift().motion, fine.step(),
                         400, lift.lift().q_guess);
  // Between times of the plan, the nearest: the feedback makes up for it.
  const dynamics::TorqueFunction controller(
      [&](int k, double t, const double* q, const double* qd, double* tau) {
        const auto n = static_cast<Eigen::Index>(std::lround(t * 400));
        const auto at = static_cast<std::size_t>(k);
        for (int i = 0; i < 6; ++i) {
          tau[i] = plan.tau[at](i, n) + 4 * (plan.states[at](i, n) - q[i]) +
                   0.8 * (plan.states[at](i + 6, n) - qd[i]);
        }
      });
  const ClosedChainSystem system(lift.lift().model, controller, Lanes::kFour);
  const auto run = [&](Figure figure, Partition partition) {
    Integration integration(system, {.method = integrators::B2PC5(),
                                     .step = lift.step(),
                                     .num_steps = lift.num_steps(),
                                     .figure = figure,
                                     .partition = partition});
    return integration.Run(lift.InitialState()).state;
  };
  const std::vector<double> serial = run(Figure::kSerial, {});
  EXPECT_LT(lift.Error(serial), 5e-3);
  EXPECT_TRUE(SameBits(run(Figure::kFigure2, {4, 1}), serial));
  EXPECT_TRUE(SameBits(run(Figure::kFigure7, {1, 2}), serial));
  EXPECT_TRUE(SameBits(run(Figure::kFigure8, {2, 2}), serial));
}

TEST(Lift, NanOfAControllerIsNamedWithItsChainAndTime) {
  const LiftCase lift(dynamics::PumaLift(), 40);
  const dynamics::TorqueFunction controller(
      [&](int k, double t, const double* q, const double* qd, double* tau) {
        lift.torques().Calc(k, t, q, qd, tau);
        if (k == 2 && t > 0.51) tau[3] = std::nan("");
      });
  const ClosedChainSystem system(lift.lift().model, controller, Lanes::kFour);
  for (const Partition partition : {Partition{1, 1}, {2, 2}, {4, 4}}) {
    Integration integration(system, {.method = integrators::B4PC5(),
                                     .step = lift.step(),
                                     .num_steps = lift.num_steps(),
                                     .figure = Figure::kFigure8,
                                     .partition = partition});
    try {
      integration.Run(lift.InitialState());
      ADD_FAILURE();
    } catch (const integrators::IntegrationError& error) {
      EXPECT_STREQ(error.what(),
                   "the acceleration of chain 2 is not finite (its torques or "
                   "its state are not) at t = 0.525000 s");
    }
  }
}

TEST(Lift, TorqueTableOfAnotherModelIsRejected) {
  const LiftCase two(dynamics::PumaLift(2), 10);
  const auto four = dynamics::PumaLift(4).model;
  EXPECT_THROW(ClosedChainSystem(four, two.torques(), Lanes::kOne),
               std::invalid_argument);
}

TEST(Lift, ChainOfFiveJointsIsNamedWithTheTime) {
  dynamics::Lift short_arm = dynamics::PumaLift(2);
  const LiftCase good(dynamics::PumaLift(2), 20);
  auto& links = short_arm.model.chains[1].arm.links;
  links.pop_back();
  const dynamics::TorqueFunction still(
      [](int k, double, const double*, const double*, double* tau) {
        std::fill_n(tau, k == 0 ? 6 : 5, 0.0);
      });
  const ClosedChainSystem system(short_arm.model, still, Lanes::kFour);
  Integration integration(system, {.step = 0.05,
                                   .num_steps = 20,
                                   .figure = Figure::kFigure8,
                                   .partition = {2, 1}});
  std::vector<double> y(12 + 10 + 13, 0.1);
  y[22] = 1;
  try {
    integration.Run(y);
    ADD_FAILURE();
  } catch (const integrators::IntegrationError& error) {
    EXPECT_STREQ(error.what(),
                 "chain 1 has 5 joints: it cannot hold the reference member in "
                 "all six directions (Lambda^-1 is not invertible) at t = "
                 "0.000000 s");
  }
}

}  // namespace
}  // namespace bench
