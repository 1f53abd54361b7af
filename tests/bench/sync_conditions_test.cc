#include "bench/sync_conditions.h"

#include <gtest/gtest.h>

namespace bench {
namespace {

SampleConditions Sample(double before, double after, std::uint64_t stolen,
                        long switches) {
  return {.before = {.round_trip = before, .stolen = 5},
          .after = {.round_trip = after, .stolen = 5 + stolen},
          .switches = switches};
}

TEST(SplitDistances, FindsTheGapBetweenTwoDistances) {
  const DistanceSplit split =
      SplitDistances({70e-9, 205e-9, 72e-9, 69e-9, 210e-9, 75e-9, 198e-9});
  ASSERT_TRUE(split.has_two());
  EXPECT_GT(split.threshold, 75e-9);
  EXPECT_LT(split.threshold, 198e-9);
  EXPECT_EQ(split.Of(71e-9), Distance::kNear);
  EXPECT_EQ(split.Of(220e-9), Distance::kFar);
}

TEST(SplitDistances, SeesOneDistanceInOrdinaryScatter) {
  const DistanceSplit split =
      SplitDistances({70e-9, 75e-9, 72e-9, 69e-9, 80e-9, 85e-9});
  EXPECT_FALSE(split.has_two());
  EXPECT_EQ(split.Of(70e-9), Distance::kOnly);
  EXPECT_EQ(split.Of(85e-9), Distance::kOnly);
}

TEST(SplitDistances, TakesARareOutlierForNoDistance) {
  std::vector<double> round_trips(100, 70e-9);
  round_trips[17] = 5e-6;
  EXPECT_FALSE(SplitDistances(round_trips).has_two());
}

TEST(SplitDistances, SeesOneDistanceWithoutASecondProcessor) {
  EXPECT_FALSE(SplitDistances({}).has_two());
  EXPECT_FALSE(SplitDistances({0, 0, 0}).has_two());
  EXPECT_FALSE(SplitDistances({70e-9}).has_two());
}

TEST(JudgeSample, BelievesASampleOfOneDistance) {
  const DistanceSplit split = {100e-9};
  EXPECT_EQ(JudgeSample(Sample(70e-9, 75e-9, 0, 0), split), Disturbance::kNone);
  EXPECT_EQ(JudgeSample(Sample(210e-9, 200e-9, 0, 0), split),
            Disturbance::kNone);
}

TEST(JudgeSample, DropsASampleInWhichTheMachineChanged) {
  const DistanceSplit split = {100e-9};
  EXPECT_EQ(JudgeSample(Sample(70e-9, 200e-9, 0, 0), split),
            Disturbance::kDistance);
  EXPECT_EQ(JudgeSample(Sample(70e-9, 70e-9, 1, 0), split),
            Disturbance::kStolen);
  EXPECT_EQ(JudgeSample(Sample(70e-9, 70e-9, 0, 2), split),
            Disturbance::kSwitched);
}

TEST(JudgeSample, NamesTheStolenTimeFirst) {
  EXPECT_EQ(JudgeSample(Sample(70e-9, 200e-9, 3, 2), DistanceSplit{100e-9}),
            Disturbance::kStolen);
}

TEST(Dropped, CountsByReason) {
  Dropped dropped;
  for (const auto reason :
       {Disturbance::kNone, Disturbance::kStolen, Disturbance::kDistance,
        Disturbance::kStolen, Disturbance::kSwitched}) {
    dropped.Add(reason);
  }
  EXPECT_EQ(dropped.distance, 1);
  EXPECT_EQ(dropped.stolen, 2);
  EXPECT_EQ(dropped.switched, 1);
  EXPECT_EQ(dropped.total(), 4);
}

TEST(StolenTicks, IsTheEighthFigureOfTheFirstLine) {
  EXPECT_EQ(StolenTicks("cpu  10 20 30 40 50 60 70 80 90 0\ncpu0 1 2"), 80u);
  EXPECT_EQ(StolenTicks("cpu  10 20 30"), 0u);
  EXPECT_EQ(StolenTicks(""), 0u);
}

}  // namespace
}  // namespace bench
