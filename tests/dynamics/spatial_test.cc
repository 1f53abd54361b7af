#include "dynamics/spatial.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "tests/dynamics/support.h"

namespace dynamics {
namespace {

SpatialVector<double> RandomSpatial(support::Random* random) {
  return {random->Vector(3, 1.0), random->Vector(3, 1.0)};
}

Matrix3<double> Skew(const Eigen::Vector3d& a) {
  Matrix3<double> M;
  M << 0, -a[2], a[1], a[2], 0, -a[0], -a[1], a[0], 0;
  return M;
}

// A body with its centre of mass at c from the point.
SpatialInertia<double> Body(double mass, const Eigen::Vector3d& c,
                            const Matrix3<double>& I_c) {
  const Matrix3<double> I = I_c - mass * Skew(c) * Skew(c);
  return {mass, mass * c, I(0, 0), I(1, 1), I(2, 2), I(0, 1), I(0, 2), I(1, 2)};
}

TEST(SpatialVector, AngularPartComesFirst) {
  support::Random random(1);
  const SpatialVector<double> v = RandomSpatial(&random);
  EXPECT_EQ(LaneOf(v, 0).head<3>(), v.angular);
  EXPECT_EQ(LaneOf(v, 0).tail<3>(), v.linear);
}

TEST(SpatialVector, ForceCrossIsMinusTheTransposeOfMotionCross) {
  support::Random random(2);
  const auto v = RandomSpatial(&random);
  const auto m = RandomSpatial(&random);
  const auto f = RandomSpatial(&random);
  EXPECT_NEAR(CrossForce(v, f).Dot(m), -f.Dot(CrossMotion(v, m)), kDirect);
}

// v x = [omega x, 0; v x, omega x].
TEST(SpatialVector, MotionCrossIsItsMatrix) {
  support::Random random(3);
  const auto v = RandomSpatial(&random);
  const auto m = RandomSpatial(&random);
  Matrix6<double> X = Matrix6<double>::Zero();
  X.topLeftCorner<3, 3>() = Skew(v.angular);
  X.bottomLeftCorner<3, 3>() = Skew(v.linear);
  X.bottomRightCorner<3, 3>() = Skew(v.angular);
  EXPECT_TRUE(IsClose(LaneOf(CrossMotion(v, m), 0), X * LaneOf(m, 0), kDirect));
}

TEST(SpatialInertia, MomentumIsThatOfTheBody) {
  support::Random random(4);
  const Eigen::Vector3d c = random.Vector(3, 1.0);
  const Matrix3<double> I_c = random.Inertia();
  const auto v = RandomSpatial(&random);
  const Eigen::Vector3d momentum = 3.0 * (v.linear + v.angular.cross(c));
  Vector6<double> expected;
  expected << I_c * v.angular + c.cross(momentum), momentum;
  EXPECT_TRUE(IsClose(LaneOf(Body(3.0, c, I_c) * v, 0), expected, kDirect));
}

TEST(SpatialInertia, SumIsTheCompositeBody) {
  support::Random random(5);
  SpatialInertia<double> both =
      Body(2.0, random.Vector(3, 1.0), random.Inertia());
  const auto one = both;
  const auto other = Body(5.0, random.Vector(3, 1.0), random.Inertia());
  const auto v = RandomSpatial(&random);
  both += other;
  EXPECT_TRUE(IsClose(LaneOf(both * v, 0),
                      LaneOf(one * v, 0) + LaneOf(other * v, 0), kDirect));
}

}  // namespace
}  // namespace dynamics
