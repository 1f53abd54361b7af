#include "dynamics/pack.h"

#include <gtest/gtest.h>

#include <limits>

#include "dynamics/spatial.h"
#include "tests/dynamics/support.h"

namespace dynamics {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

template <typename P>
P RandomPack(support::Random* random) {
  P x;
  for (int lane = 0; lane < kLanesOf<P>; ++lane) {
    x.Set(lane, random->Uniform(-10, 10));
  }
  return x;
}

template <typename P>
class PackTest : public testing::Test {};
using Packs = testing::Types<Pack<2>, Pack<4>>;
TYPED_TEST_SUITE(PackTest, Packs);

TYPED_TEST(PackTest, ConstructorFillsAllLanes) {
  for (const double x : {3.5, -0.0}) {
    const TypeParam pack(x);
    for (int lane = 0; lane < kLanesOf<TypeParam>; ++lane) {
      EXPECT_TRUE(SameBits(pack[lane], x));
    }
  }
}

TYPED_TEST(PackTest, ArithmeticIsThatOfEveryLane) {
  support::Random random(2);
  const auto a = RandomPack<TypeParam>(&random);
  const auto b = RandomPack<TypeParam>(&random);
  TypeParam sum = a, difference = a, product = a, quotient = a;
  sum += b;
  difference -= b;
  product *= b;
  quotient /= b;
  for (int lane = 0; lane < kLanesOf<TypeParam>; ++lane) {
    EXPECT_EQ((a + b)[lane], a[lane] + b[lane]);
    EXPECT_EQ((a - b)[lane], a[lane] - b[lane]);
    EXPECT_EQ((a * b)[lane], a[lane] * b[lane]);
    EXPECT_EQ((a / b)[lane], a[lane] / b[lane]);
    EXPECT_EQ((-a)[lane], -a[lane]);
    EXPECT_EQ(sum[lane], a[lane] + b[lane]);
    EXPECT_EQ(difference[lane], a[lane] - b[lane]);
    EXPECT_EQ(product[lane], a[lane] * b[lane]);
    EXPECT_EQ(quotient[lane], a[lane] / b[lane]);
  }
}

TYPED_TEST(PackTest, SetLaneLeavesTheOthers) {
  for (int set = 0; set < kLanesOf<TypeParam>; ++set) {
    TypeParam pack(1.0);
    SetLane(&pack, set, 7.0);
    for (int lane = 0; lane < kLanesOf<TypeParam>; ++lane) {
      EXPECT_EQ(Lane(pack, lane), lane == set ? 7.0 : 1.0);
    }
  }
}

TYPED_TEST(PackTest, MinOfEveryLaneKeepsANanOfTheFirst) {
  TypeParam a(1.0), b(2.0);
  a.Set(0, kNan);
  b.Set(1, -2.0);
  const TypeParam smaller = Min(a, b);
  EXPECT_NE(smaller[0], smaller[0]);
  EXPECT_EQ(smaller[1], -2.0);
  EXPECT_NE(Min(kNan, 1.0), Min(kNan, 1.0));
  EXPECT_EQ(Min(3.0, 1.0), 1.0);
}

TYPED_TEST(PackTest, ProductOfMatricesIsThatOfEveryLane) {
  support::Random random(3);
  Matrix3<TypeParam> A;
  Vector3<TypeParam> x;
  for (auto& a : A.reshaped()) a = RandomPack<TypeParam>(&random);
  for (auto& a : x) a = RandomPack<TypeParam>(&random);
  const Vector3<TypeParam> y = A * x;
  for (int lane = 0; lane < kLanesOf<TypeParam>; ++lane) {
    EXPECT_TRUE(IsClose(LaneOf(y, lane), LaneOf(A, lane) * LaneOf(x, lane),
                        1e-15, 300));  // three products of at most 100
  }
}

TEST(Pack, HasItsNumberOfLanesAndADoubleHasOne) {
  EXPECT_EQ(kLanesOf<double>, 1);
  EXPECT_EQ(kLanesOf<Pack<2>>, 2);
  EXPECT_EQ(kLanesOf<Pack<4>>, 4);
  EXPECT_EQ(sizeof(Pack<4>), 4 * sizeof(double));
}

}  // namespace
}  // namespace dynamics
