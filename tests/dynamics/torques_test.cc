#include "dynamics/torques.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "tests/dynamics/support.h"

namespace dynamics {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

// Two chains, of two joints and of one, at the times n step.
template <typename Function>
TorqueTable Tabulate(double step, int num_times, const Function& function) {
  std::vector<Eigen::MatrixXd> profile = {Eigen::MatrixXd(2, num_times),
                                          Eigen::MatrixXd(1, num_times)};
  for (int n = 0; n < num_times; ++n) {
    const double t = n * step;
    profile[0].col(n) << function(t), -2 * function(t);
    profile[1].col(n) << 3 * function(t);
  }
  return TorqueTable(step, profile);
}

double First(const TorqueTable& table, double t) {
  double tau[2];
  table.Calc(0, t, nullptr, nullptr, tau);
  EXPECT_EQ(tau[1], -2 * tau[0]);
  return tau[0];
}

double Quintic(double t) {
  return 1 + t * (-2 + t * (0.5 + t * (3 + t * (-1 + t * 0.7))));
}

TEST(TorqueTable, IsExactOnTheGridHoweverItsTimesAreRounded) {
  constexpr double kStep = 0.1;  // not a binary fraction
  const auto table = Tabulate(kStep, 11, [](double t) { return std::exp(t); });
  double sum = 0;
  for (int n = 0; n <= 10; ++n) {
    EXPECT_EQ(First(table, n * kStep), std::exp(n * kStep));
    EXPECT_EQ(First(table, sum), std::exp(n * kStep));
    sum += kStep;
  }
  double tau;
  table.Calc(1, 0.3, nullptr, nullptr, &tau);
  EXPECT_EQ(tau, 3 * std::exp(3 * kStep));
}

TEST(TorqueTable, IsExactForQuinticsBetweenTheTimes) {
  const auto table = Tabulate(0.125, 9, Quintic);
  for (double t = 0; t <= 1; t += 0.01) {
    EXPECT_NEAR(First(table, t), Quintic(t), kDirect * 5);
  }
}

TEST(TorqueTable, InterpolatesWithOrderSix) {
  const auto error = [](int num_steps) {
    const double step = 1.0 / num_steps;
    const auto table =
        Tabulate(step, num_steps + 1, [](double t) { return std::exp(2 * t); });
    double largest = 0;
    for (double t = 0; t <= 1; t += 0.001) {
      largest = std::max(largest, std::abs(First(table, t) - std::exp(2 * t)));
    }
    return largest;
  };
  // The slope tends to 6 from below: the largest sixth derivative is that at
  // the end, and the last six times come nearer to it.
  EXPECT_NEAR(std::log2(error(20) / error(40)), 6, 0.3);
}

TEST(TorqueTable, KnowsItsStepAndDuration) {
  const auto table = Tabulate(0.25, 9, Quintic);
  EXPECT_EQ(table.step(), 0.25);
  EXPECT_EQ(table.duration(), 2);
}

TEST(TorqueTable, ThrowsOutsideOfItsTimes) {
  const auto table = Tabulate(0.25, 9, Quintic);
  for (const double t : {-0.1, -0.25, -1.0, 2.1, 2.25, 100.0, kNan}) {
    EXPECT_THROW(First(table, t), std::out_of_range) << t;
  }
  EXPECT_EQ(MessageOf<std::out_of_range>([&] { First(table, 2.25); }),
            "the torque table ends at 2.000000 s: no torques at t = 2.250000 "
            "s");
}

TEST(TorqueTable, ForgivesARoundingErrorAtItsEnds) {
  const auto table = Tabulate(0.25, 9, Quintic);
  EXPECT_EQ(First(table, std::nextafter(2.0, 3.0)), Quintic(2));
  EXPECT_EQ(First(table, -1e-17), Quintic(0));
}

TEST(TorqueTable, NamesChainJointAndTimeOfATorqueThatIsNotFinite) {
  for (const double bad : {kNan, std::numeric_limits<double>::infinity()}) {
    std::vector<Eigen::MatrixXd> profile(3, Eigen::MatrixXd::Zero(6, 20));
    profile[2](4, 7) = bad;
    EXPECT_EQ(MessageOf<std::invalid_argument>(
                  [&] { TorqueTable table(0.01, profile); }),
              "the torque of chain 2, joint 5, at t = 0.070000 s is not a "
              "finite number");
  }
}

TEST(TorqueTable, RejectsFewerThanSixTimesAndUnequalNumbersOfThem) {
  const auto complaint = [](int first, int second) {
    return MessageOf<std::invalid_argument>([&] {
      TorqueTable table(0.01, {Eigen::MatrixXd::Zero(6, first),
                               Eigen::MatrixXd::Zero(7, second)});
    });
  };
  EXPECT_EQ(complaint(6, 6), "");
  EXPECT_TRUE(Contains(complaint(5, 5), "chain 0 has 5 times"));
  EXPECT_TRUE(Contains(complaint(8, 9), "chain 1 has 9 times"));
}

TEST(TorqueTable, RejectsAStepThatIsNotPositive) {
  for (const double step : {0.0, -0.1, kNan}) {
    EXPECT_THROW(TorqueTable(step, {Eigen::MatrixXd::Zero(6, 6)}),
                 std::invalid_argument);
  }
}

TEST(TorqueFunction, PassesItsArgumentsOn) {
  const TorqueFunction function(
      [](int k, double t, const double* q, const double* qd, double* tau) {
        tau[0] = k + 10 * t + 100 * q[0] + 1000 * qd[0];
      });
  const double q = 3, qd = 4;
  double tau;
  function.Calc(1, 2, &q, &qd, &tau);
  EXPECT_EQ(tau, 4321);
}

}  // namespace
}  // namespace dynamics
