#include "bench/sync_break_even.h"

#include <gtest/gtest.h>

#include <cmath>

namespace bench {
namespace {

TEST(LeastWork, InterpolatesInTheLogarithmOfTheWork) {
  // From 0.25 at 1 us to 0.75 at 4 us: 0.5 is half way, at 2 us.
  const auto work = LeastWork({{1e-6, 0.25}, {4e-6, 0.75}}, 0.5);
  ASSERT_TRUE(work);
  EXPECT_NEAR(*work, 2e-6, 1e-12);
}

// E = w / (w + c) passes 0.5 at c and 0.9 at 9 c.
TEST(LeastWork, FindsThoseOfAConstantCost) {
  constexpr double kCost = 80e-9;
  std::vector<EfficiencyPoint> points;
  for (int i = 0; i < 18; ++i) {
    const double work = 10e-9 * std::pow(2, i);
    points.push_back({work, work / (work + kCost)});
  }
  EXPECT_NEAR(*LeastWork(points, 0.5) / kCost, 1, 0.01);
  EXPECT_NEAR(*LeastWork(points, 0.9) / kCost, 9, 0.4);
}

TEST(LeastWork, TakesTheLastCrossing) {
  const auto work = LeastWork({{1, 0.6}, {2, 0.4}, {4, 0.6}, {8, 0.7}}, 0.5);
  EXPECT_NEAR(*work, std::sqrt(8.0), 1e-12);
}

TEST(LeastWork, IsNothingIfTheEfficiencyIsNeverReached) {
  EXPECT_FALSE(LeastWork({{1, 0.2}, {2, 0.4}}, 0.5));
  EXPECT_FALSE(LeastWork({{1, 0.6}, {2, 0.4}}, 0.5));
  EXPECT_FALSE(LeastWork({}, 0.5));
}

TEST(LeastWork, IsTheFirstIfAllWorkIsEnough) {
  EXPECT_EQ(LeastWork({{1, 0.8}, {2, 0.9}}, 0.5), 1);
}

TEST(SummarizeWork, HasTheBoundsOfTheEfficiencyAsItsInterval) {
  const WorkSummary summary = SummarizeWork(
      {{1, 0.2, {0.1, 0.3}}, {4, 0.8, {0.3, 0.9}}, {16, 0.9, {0.7, 1.0}}}, 0.5);
  ASSERT_TRUE(summary.median && summary.low && summary.high);
  EXPECT_NEAR(*summary.median, 2, 1e-12);
  EXPECT_GT(*summary.low, 1);
  EXPECT_LT(*summary.low, 2);
  EXPECT_NEAR(*summary.high, 8, 1e-12);
}

TEST(SummarizeWork, HasNoUpperBoundIfTheLowerEfficiencyStaysBelow) {
  const WorkSummary summary =
      SummarizeWork({{1, 0.2, {0.1, 0.3}}, {4, 0.8, {0.4, 0.9}}}, 0.5);
  EXPECT_TRUE(summary.median);
  EXPECT_FALSE(summary.high);
  EXPECT_FALSE(SummarizeWork({}, 0.5).median);
}

}  // namespace
}  // namespace bench
