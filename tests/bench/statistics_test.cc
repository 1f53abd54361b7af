#include "bench/statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <stdexcept>
#include <vector>

namespace bench {
namespace {

TEST(Median, IsTheMiddleOfSortedSamples) {
  EXPECT_EQ(Median({3, 1, 2}), 2);
  EXPECT_EQ(Median({4, 1, 3, 2}), 2.5);
  EXPECT_EQ(Median({7}), 7);
  EXPECT_THROW(Median({}), std::invalid_argument);
}

TEST(Median, IsNotMovedByAnOutlier) { EXPECT_EQ(Median({1, 2, 1e9}), 2); }

std::vector<double> OneTo(int n) {
  std::vector<double> samples(static_cast<std::size_t>(n));
  std::iota(samples.begin(), samples.end(), 1.0);
  return samples;
}

// Ranks r with P(X < r) <= 2.5 % for X binomial with p = 1/2, added up by hand.
TEST(MedianInterval, HasTheRanksOfTheBinomialDistribution) {
  const struct {
    int n;
    double low, high;
  } kRanks[] = {{6, 1, 6},  {8, 1, 8},   {9, 2, 8},
                {10, 2, 9}, {20, 6, 15}, {100, 40, 61}};
  for (const auto& [n, low, high] : kRanks) {
    const Interval interval = MedianInterval(OneTo(n));
    EXPECT_EQ(interval.low, low) << n;
    EXPECT_EQ(interval.high, high) << n;
  }
}

TEST(MedianInterval, OfFewSamplesIsTheirRange) {
  const Interval interval = MedianInterval({5, 1, 3});
  EXPECT_EQ(interval.low, 1);
  EXPECT_EQ(interval.high, 5);
}

TEST(Percentile, InterpolatesBetweenNeighbours) {
  EXPECT_EQ(Percentile({30, 10, 20}, 0), 10);
  EXPECT_EQ(Percentile({30, 10, 20}, 0.5), 20);
  EXPECT_EQ(Percentile({30, 10, 20}, 0.75), 25);
  EXPECT_EQ(Percentile({30, 10, 20}, 1), 30);
  EXPECT_EQ(Percentile({7}, 0.95), 7);
  EXPECT_THROW(Percentile({}, 0.5), std::invalid_argument);
}

TEST(Summarize, SaysWhatItsPartsSay) {
  const std::vector<double> samples = {5, 1, 3, 2, 4};
  const Summary summary = Summarize(samples);
  EXPECT_EQ(summary.median, 3);
  EXPECT_EQ(summary.interval.low, MedianInterval(samples).low);
  EXPECT_EQ(summary.interval.high, MedianInterval(samples).high);
  EXPECT_EQ(summary.min, 1);
  EXPECT_NEAR(summary.p95, 4.8, 1e-12);
  EXPECT_EQ(summary.n, 5);
}

TEST(Ratios, AreTakenPairByPair) {
  EXPECT_EQ(Ratios({2, 9}, {1, 3}), (std::vector<double>{2, 3}));
  EXPECT_THROW(Ratios({1}, {}), std::invalid_argument);
}

TEST(PowerLaw, IsFoundExactlyInExactData) {
  std::vector<double> x, y;
  for (double n = 20; n < 200; n *= 1.3) {
    x.push_back(n);
    y.push_back(3e4 * std::pow(n, -5));
  }
  const PowerLaw law = FitPowerLaw(x, y);
  EXPECT_NEAR(law.slope, -5, 1e-12);
  EXPECT_NEAR(law.X(3e4 * std::pow(77, -5)), 77, 1e-9);
}

TEST(PowerLaw, NeedsTwoDifferentPoints) {
  EXPECT_THROW(FitPowerLaw({1}, {1}), std::invalid_argument);
  EXPECT_THROW(FitPowerLaw({2, 2}, {1, 3}), std::invalid_argument);
}

}  // namespace
}  // namespace bench
