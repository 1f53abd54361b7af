#include "dynamics/sincos.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "tests/dynamics/support.h"

namespace dynamics {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

// What the header promises for |x| < 1e5.
constexpr long double kError = 0x1p-52L;

void ExpectAccurate(double x) {
  double sine, cosine;
  SinCos(x, &sine, &cosine);
  EXPECT_LT(std::abs(sine - std::sin(static_cast<long double>(x))), kError)
      << "sine of " << x;
  EXPECT_LT(std::abs(cosine - std::cos(static_cast<long double>(x))), kError)
      << "cosine of " << x;
}

std::vector<double> Arguments() {
  support::Random random(1);
  std::vector<double> all = {0.0, -0.0, 1e-300, 1e-9, kNan, kInfinity};
  for (double range = 0.1; range < 2e5; range *= 10) {
    for (int i = 0; i < 1000; ++i) all.push_back(random.Uniform(-range, range));
  }
  while (all.size() % 4 != 0) all.push_back(1.0);
  return all;
}

TEST(SinCos, ErrorIsBelowTwoToTheMinus52WithinItsRange) {
  for (const double x : Arguments()) {
    if (std::isfinite(x) && std::abs(x) < 1e5) ExpectAccurate(x);
  }
}

// Where the reduced argument is as small, or as near to pi / 4, as it gets.
TEST(SinCos, ErrorIsBelowTwoToTheMinus52AtMultiplesOfAnEighthTurn) {
  for (int n = -127000; n <= 127000; n += 13) {
    const double x = n * (std::numbers::pi / 4);
    ExpectAccurate(x);
    ExpectAccurate(std::nextafter(x, kInfinity));
    ExpectAccurate(std::nextafter(x, -kInfinity));
  }
}

TEST(SinCos, SignsFollowTheQuadrant) {
  const int sine_sign[] = {1, 1, -1, -1};
  const int cosine_sign[] = {1, -1, -1, 1};
  for (int quadrant = -8; quadrant < 8; ++quadrant) {
    double sine, cosine;
    SinCos((quadrant + 0.3) * std::numbers::pi / 2, &sine, &cosine);
    EXPECT_GT(sine * sine_sign[quadrant & 3], 0) << quadrant;
    EXPECT_GT(cosine * cosine_sign[quadrant & 3], 0) << quadrant;
  }
}

TEST(SinCos, ZeroIsExact) {
  double sine, cosine;
  SinCos(0.0, &sine, &cosine);
  EXPECT_EQ(sine, 0.0);
  EXPECT_EQ(cosine, 1.0);
}

TEST(SinCos, SineIsOddAndCosineEvenBitForBit) {
  for (const double x : Arguments()) {
    if (!std::isfinite(x) || x == 0) continue;
    double sine, cosine, sine_minus, cosine_minus;
    SinCos(x, &sine, &cosine);
    SinCos(-x, &sine_minus, &cosine_minus);
    EXPECT_TRUE(SameBits(-sine, sine_minus)) << x;
    EXPECT_TRUE(SameBits(cosine, cosine_minus)) << x;
  }
}

TEST(SinCos, NanAndInfinityGiveNan) {
  for (const double x : {kNan, kInfinity, -kInfinity}) {
    double sine, cosine;
    SinCos(x, &sine, &cosine);
    EXPECT_TRUE(std::isnan(sine)) << x;
    EXPECT_TRUE(std::isnan(cosine)) << x;
  }
}

template <int kLanes>
void ExpectLanesEqualDoubles() {
  const std::vector<double> all = Arguments();
  for (std::size_t i = 0; i < all.size(); i += kLanes) {
    Pack<kLanes> x, sines, cosines;
    for (int lane = 0; lane < kLanes; ++lane) x.Set(lane, all[i + lane]);
    SinCos(x, &sines, &cosines);
    for (int lane = 0; lane < kLanes; ++lane) {
      if (!std::isfinite(x[lane])) continue;  // the bits of NaN are not ours
      double sine, cosine;
      SinCos(x[lane], &sine, &cosine);
      EXPECT_TRUE(SameBits(sines[lane], sine)) << x[lane];
      EXPECT_TRUE(SameBits(cosines[lane], cosine)) << x[lane];
    }
  }
}

TEST(SinCos, LanesOfAPackEqualDoublesBitForBit) {
  ExpectLanesEqualDoubles<2>();
  ExpectLanesEqualDoubles<4>();
}

TEST(SinCos, LaneDoesNotDependOnItsNeighbours) {
  for (const double neighbour : {0.0, -3.0, 1e6, 1e300, kInfinity, kNan}) {
    for (int lane = 0; lane < 4; ++lane) {
      Pack<4> alone(1.25), among(neighbour);
      among.Set(lane, 1.25);
      Pack<4> sine, cosine, sine_among, cosine_among;
      SinCos(alone, &sine, &cosine);
      SinCos(among, &sine_among, &cosine_among);
      EXPECT_TRUE(SameBits(sine[lane], sine_among[lane])) << neighbour;
      EXPECT_TRUE(SameBits(cosine[lane], cosine_among[lane])) << neighbour;
    }
  }
}

}  // namespace
}  // namespace dynamics
