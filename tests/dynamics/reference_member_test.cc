#include "dynamics/reference_member.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <numbers>

#include "tests/dynamics/support.h"

namespace dynamics {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
const Eigen::Vector3d kGravity = {0, 0, -9.81};

ReferenceMember Member123() {
  return {.mass = 2, .inertia = Eigen::Vector3d(1, 2, 3).asDiagonal()};
}

MemberState<double> At(const Eigen::Quaterniond& Q,
                       const Eigen::Vector3d& omega) {
  return {.Q = {Q.w(), Q.x(), Q.y(), Q.z()},
          .p = {1, 2, 3},
          .omega = omega,
          .v = {4, 5, 6}};
}

MemberState<double> RandomState(support::Random* random) {
  MemberState<double> state =
      At(Eigen::Quaterniond(random->Rotation()), random->Vector(3, 2.0));
  state.v = random->Vector(3, 2.0);
  return state;
}

// No chain holds it.
TipInertia<double> Nothing() {
  TipInertia<double> sum;
  sum.Lambda.fill(0);
  sum.Lambda_a_open.fill(0);
  return sum;
}

// A chain with the given Lambda and Lambda x''_open.
TipInertia<double> Tip(const Matrix6<double>& Lambda,
                       const Vector6<double>& Lambda_a_open) {
  TipInertia<double> tip;
  int element = 0;
  for (int a = 0; a < 6; ++a) {
    for (int b = 0; b <= a; ++b) tip.Lambda[element++] = Lambda(a, b);
    tip.Lambda_a_open[a] = Lambda_a_open[a];
  }
  return tip;
}

Matrix6<double> RandomLambda(support::Random* random) {
  Matrix6<double> B;
  for (int i = 0; i < 6; ++i) B.col(i) = random->Vector(6, 1.0);
  return B * B.transpose() + Matrix6<double>::Identity();
}

Vector6<double> Stack(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  Vector6<double> v;
  v << a, b;
  return v;
}

TEST(MemberAxes, AreThoseOfTheQuaternion) {
  support::Random random(1);
  const Eigen::Matrix3d R = random.Rotation();
  const Eigen::Quaterniond Q(R);
  EXPECT_TRUE(IsClose(MemberAxes(At(Q, {0, 0, 0}).Q), R, kDirect));
}

TEST(MemberAxes, DoNotDependOnTheNormOfTheQuaternion) {
  support::Random random(2);
  const auto state = RandomState(&random);
  for (const double scale : {2.0, 0.25, -4.0}) {  // exact in binary
    std::array<double, 4> Q = state.Q;
    for (double& x : Q) x *= scale;
    EXPECT_TRUE(HasSameBits(MemberAxes(Q), MemberAxes(state.Q)));
  }
  std::array<double, 4> Q = state.Q;
  for (double& x : Q) x *= 1.1;
  EXPECT_TRUE(IsClose(MemberAxes(Q), MemberAxes(state.Q), kDirect));
}

// omega x I omega = (1, 1, 1) x (1, 2, 3) = (1, -2, 1).
TEST(CalcMemberAcceleration, OfATumblingFreeBodyIsEulersByHand) {
  const auto state = At(Eigen::Quaterniond::Identity(), {1, 1, 1});
  Vector6<double> a_r;
  const double margin =
      CalcMemberAcceleration(Member123(), kGravity, state, Nothing(), &a_r);
  EXPECT_GT(margin, 0);
  EXPECT_TRUE(IsClose(a_r, Stack({-1, 1, -1.0 / 3}, {0, 0, -9.81}), kDirect));
}

// A quarter turn about z: I is diag(2, 1, 3) in world axes, omega x I omega =
// (2, -1, -1).
TEST(CalcMemberAcceleration, UsesTheInertiaInWorldAxes) {
  const Eigen::Quaterniond quarter(
      Eigen::AngleAxisd(std::numbers::pi / 2, Eigen::Vector3d::UnitZ()));
  Vector6<double> a_r;
  CalcMemberAcceleration(Member123(), kGravity, At(quarter, {1, 1, 1}),
                         Nothing(), &a_r);
  EXPECT_TRUE(IsClose(a_r, Stack({-1, 1, 1.0 / 3}, {0, 0, -9.81}), kDirect));
}

// At rest; Lambda = 4 on the diagonal, Lambda x''_open = 12 along each axis:
// (I + 4) omega' = 12, (2 + 4) v' = 12 + 2 g.
TEST(CalcMemberAcceleration, HeldByOneChainIsByHand) {
  const TipInertia<double> tip =
      Tip(4 * Matrix6<double>::Identity(), Vector6<double>::Constant(12));
  Vector6<double> a_r;
  CalcMemberAcceleration(Member123(), kGravity,
                         At(Eigen::Quaterniond::Identity(), {0, 0, 0}), tip,
                         &a_r);
  EXPECT_TRUE(IsClose(a_r, Stack({12.0 / 5, 2, 12.0 / 7}, {2, 2, 2 - 9.81 / 3}),
                      kDirect));
}

TEST(CalcMemberAcceleration, SolvesEquationTenWithCoupledTips) {
  support::Random random(3);
  for (int i = 0; i < 20; ++i) {
    const auto state = RandomState(&random);
    const ReferenceMember member = {.mass = 3, .inertia = random.Inertia()};
    const Matrix6<double> Lambda = RandomLambda(&random);
    const Vector6<double> Lambda_a_open = random.Vector(6, 20.0);
    const Eigen::Matrix3d R = MemberAxes(state.Q);
    const Eigen::Matrix3d I = R * member.inertia * R.transpose();
    Matrix6<double> A = Lambda;
    A.topLeftCorner<3, 3>() += I;
    A.bottomRightCorner<3, 3>() += 3 * Eigen::Matrix3d::Identity();
    const Vector6<double> rhs =
        Lambda_a_open +
        Stack(-state.omega.cross(I * state.omega), 3 * kGravity);
    Vector6<double> a_r;
    CalcMemberAcceleration(member, kGravity, state, Tip(Lambda, Lambda_a_open),
                           &a_r);
    EXPECT_TRUE(IsClose(A * a_r, rhs, kDirect));
  }
}

TEST(CalcMemberAcceleration, DoesNotDependOnTheNormOfTheQuaternion) {
  support::Random random(4);
  auto state = RandomState(&random);
  const TipInertia<double> tip =
      Tip(RandomLambda(&random), random.Vector(6, 20.0));
  Vector6<double> a_r, a_r_scaled;
  CalcMemberAcceleration(Member123(), kGravity, state, tip, &a_r);
  for (double& x : state.Q) x *= 2;
  CalcMemberAcceleration(Member123(), kGravity, state, tip, &a_r_scaled);
  EXPECT_TRUE(HasSameBits(a_r, a_r_scaled));
}

TEST(CalcMemberAcceleration, MarginIsNotPositiveInTheLaneThatFailed) {
  support::Random random(5);
  const auto state = RandomState(&random);
  const TipInertia<double> sound =
      Tip(RandomLambda(&random), random.Vector(6, 20.0));
  MemberState<Pack<4>> states;
  for (int i = 0; i < 4; ++i) states.Q[i] = Pack<4>(state.Q[i]);
  for (int i = 0; i < 3; ++i) {
    states.p[i] = Pack<4>(state.p[i]);
    states.omega[i] = Pack<4>(state.omega[i]);
    states.v[i] = Pack<4>(state.v[i]);
  }
  TipInertia<Pack<4>> tips;
  for (int i = 0; i < kTriangle6; ++i)
    tips.Lambda[i] = Pack<4>(sound.Lambda[i]);
  for (int i = 0; i < 6; ++i) {
    tips.Lambda_a_open[i] = Pack<4>(sound.Lambda_a_open[i]);
  }
  tips.Lambda_a_open[5].Set(0, kNan);
  tips.Lambda_a_open[0].Set(1, std::numeric_limits<double>::infinity());
  tips.Lambda[kTriangle6 - 1].Set(2, -100.0);
  Vector6<Pack<4>> a_r;
  const Pack<4> margin =
      CalcMemberAcceleration(Member123(), kGravity, states, tips, &a_r);
  for (int lane = 0; lane < 3; ++lane) EXPECT_FALSE(margin[lane] > 0) << lane;
  EXPECT_GT(margin[3], 0);
  Vector6<double> alone;
  CalcMemberAcceleration(Member123(), kGravity, state, sound, &alone);
  EXPECT_TRUE(IsClose(LaneOf(a_r, 3), alone, kDirect));
}

TEST(CalcMemberForce, OfAFreeBodyIsZero) {
  support::Random random(6);
  const auto state = RandomState(&random);
  Vector6<double> a_r;
  CalcMemberAcceleration(Member123(), kGravity, state, Nothing(), &a_r);
  EXPECT_TRUE(IsClose(CalcMemberForce(Member123(), kGravity, state, a_r),
                      Vector6<double>::Zero(), kDirect, 2 * 9.81));
}

TEST(CalcMemberForce, AtRestIsTheWeight) {
  const auto state = At(Eigen::Quaterniond::Identity(), {0, 0, 0});
  EXPECT_TRUE(IsClose(
      CalcMemberForce(Member123(), kGravity, state, Vector6<double>::Zero()),
      Stack({0, 0, 0}, {0, 0, 2 * 9.81}), kDirect));
}

TEST(MemberDerivative, OfTheQuaternionTurnsTheAxesWithOmegaInWorldAxes) {
  support::Random random(7);
  auto state = RandomState(&random);
  for (double& x : state.Q) x *= 1.3;  // the norm is free
  const MemberState<double> rate =
      MemberDerivative(state, Vector6<double>(random.Vector(6, 1.0)));
  // Central difference: third derivative of order 10, rounding 1e-16 / h.
  constexpr double h = 1e-5;
  std::array<double, 4> before, after;
  for (int i = 0; i < 4; ++i) {
    before[i] = state.Q[i] - h * rate.Q[i];
    after[i] = state.Q[i] + h * rate.Q[i];
  }
  const Eigen::Matrix3d R_rate =
      (MemberAxes(after) - MemberAxes(before)) / (2 * h);
  const Eigen::Matrix3d R = MemberAxes(state.Q);
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_TRUE(
        IsClose(R_rate.col(axis), state.omega.cross(R.col(axis)), 1e-9));
  }
}

TEST(MemberDerivative, OfTheQuaternionKeepsItsNorm) {
  support::Random random(8);
  const auto state = RandomState(&random);
  const auto rate = MemberDerivative(state, Vector6<double>::Zero().eval());
  double along = 0;
  for (int i = 0; i < 4; ++i) along += state.Q[i] * rate.Q[i];
  EXPECT_NEAR(along, 0, kDirect);
}

TEST(MemberDerivative, IsVelocityAndAcceleration) {
  support::Random random(9);
  const auto state = RandomState(&random);
  const Vector6<double> a_r = random.Vector(6, 1.0);
  const auto rate = MemberDerivative(state, a_r);
  EXPECT_EQ(rate.p, state.v);
  EXPECT_EQ(rate.omega, a_r.head<3>());
  EXPECT_EQ(rate.v, a_r.tail<3>());
}

MemberState<double> Ahead(const MemberState<double>& y, double h,
                          const MemberState<double>& rate) {
  MemberState<double> ahead = y;
  for (int i = 0; i < 4; ++i) ahead.Q[i] += h * rate.Q[i];
  ahead.p += h * rate.p;
  ahead.omega += h * rate.omega;
  ahead.v += h * rate.v;
  return ahead;
}

// Rates of a free body, for classical Runge-Kutta.
MemberState<double> FreeRate(const MemberState<double>& y) {
  Vector6<double> a_r;
  CalcMemberAcceleration(Member123(), kGravity, y, Nothing(), &a_r);
  return MemberDerivative(y, a_r);
}

TEST(MemberDerivative, OfAFreeBodyConservesEnergyAndAngularMomentum) {
  const auto momentum = [](const MemberState<double>& y) {
    const Eigen::Matrix3d R = MemberAxes(y.Q);
    return Eigen::Vector3d(R * Member123().inertia * R.transpose() * y.omega);
  };
  const auto energy = [&](const MemberState<double>& y) {
    return 0.5 * y.omega.dot(momentum(y)) +
           Member123().mass * (0.5 * y.v.dot(y.v) - kGravity.dot(y.p));
  };
  support::Random random(10);
  const MemberState<double> start = RandomState(&random);
  MemberState<double> y = start;
  constexpr double h = 1e-3;
  for (int n = 0; n < 1000; ++n) {
    const auto k1 = FreeRate(y);
    const auto k2 = FreeRate(Ahead(y, h / 2, k1));
    const auto k3 = FreeRate(Ahead(y, h / 2, k2));
    const auto k4 = FreeRate(Ahead(y, h, k3));
    y = Ahead(y, h / 6, k1);
    y = Ahead(y, h / 3, k2);
    y = Ahead(y, h / 3, k3);
    y = Ahead(y, h / 6, k4);
  }
  // Order 4: (rate of turn h)^4 with a rate below 10 per second.
  EXPECT_TRUE(IsClose(momentum(y), momentum(start), 1e-8));
  EXPECT_NEAR(energy(y), energy(start), 1e-8 * std::abs(energy(start)));
  EXPECT_TRUE(IsClose(y.p, start.p + start.v + kGravity / 2, 1e-11));
}

}  // namespace
}  // namespace dynamics
