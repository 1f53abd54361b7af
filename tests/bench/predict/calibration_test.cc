// From samples to costs: the arithmetic of the calibration.

#include "bench/predict/calibration.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <numeric>
#include <utility>
#include <vector>

#include "bench/predict/block_calibration.h"
#include "bench/predict/wait_calibration.h"

namespace bench::predict {
namespace {

BlockSample SampleOf(double packs, double items, double seconds) {
  BlockSample sample;
  sample.counts = {packs, items, 0};
  sample.seconds = seconds;
  return sample;
}

TEST(FitBlock, FindsTheCostsThatSamplesWereMadeOf) {
  const BlockCost made = {.call = 20e-9, .pack = 800e-9, .item = 15e-9};
  std::vector<BlockSample> samples;
  for (const auto& [packs, items] :
       {std::pair{1, 1}, {1, 4}, {2, 6}, {3, 12}, {5, 20}}) {
    samples.push_back(SampleOf(packs, items, made.Seconds(packs, items)));
  }
  const BlockCost fit = FitBlock(samples);
  EXPECT_NEAR(fit.call, made.call, 1e-12);
  EXPECT_NEAR(fit.pack, made.pack, 1e-12);
  EXPECT_NEAR(fit.item, made.item, 1e-12);
}

TEST(FitBlock, HasNoNegativeCosts) {
  const BlockCost fit =
      FitBlock({SampleOf(1, 4, 100e-9), SampleOf(2, 8, 250e-9),
                SampleOf(4, 16, 600e-9)});
  EXPECT_GE(fit.call, 0);
  EXPECT_GE(fit.pack, 0);
  EXPECT_GE(fit.item, 0);
  EXPECT_NEAR(fit.Seconds(2, 8), 250e-9, 50e-9);
}

TEST(FitBlock, FitsSamplesThatDoNotTellPacksFromItems) {
  const BlockCost fit =
      FitBlock({SampleOf(1, 1, 900e-9), SampleOf(4, 4, 3600e-9)});
  EXPECT_NEAR(fit.Seconds(1, 1), 900e-9, 1e-12);
  EXPECT_NEAR(fit.Seconds(4, 4), 3600e-9, 1e-12);
}

TEST(MediansOfGroups, MergeSamplesOfTheSameCounts) {
  const auto medians = MediansOfGroups({SampleOf(1, 1, 3), SampleOf(1, 1, 1),
                                        SampleOf(1, 1, 2), SampleOf(2, 1, 5)});
  ASSERT_EQ(medians.size(), 2u);
  EXPECT_EQ(medians[0].seconds, 2);
  EXPECT_EQ(medians[1].seconds, 5);
}

TEST(SpreadOf, AscendsAndLeavesTheExtremesOut) {
  std::vector<double> ratios(1001);
  std::iota(ratios.begin(), ratios.end(), 0);
  const Spread spread = SpreadOf(ratios);
  ASSERT_GT(spread.size(), 2u);
  EXPECT_TRUE(std::is_sorted(spread.begin(), spread.end()));
  EXPECT_EQ(spread.front(), 5);
  EXPECT_EQ(spread.back(), 995);
  EXPECT_TRUE(SpreadOf({1, 2}).empty());
}

SyncRow RowOf(const char* construct, const char* by, int num_tasks,
              double overhead, Distance distance = Distance::kNear) {
  SyncRow row;
  row.variant.construct = construct;
  row.variant.by = by;
  row.variant.num_tasks = num_tasks;
  row.distance = distance;
  row.overhead = Summary{overhead, {overhead, overhead}, overhead, overhead, 9};
  return row;
}

TEST(FitWaits, TakesEachCostFromItsRow) {
  using macrotask::WaitKind;
  const std::vector<SyncRow> rows = {
      RowOf("BARSYNC, counter", "hold", 2, 60e-9),
      RowOf("BARSYNC, counter", "hold", 2, 250e-9, Distance::kFar),
      RowOf("BARSYNC, counter", "spin", 2, 80e-9),
      RowOf("BARSYNC, dissemination", "hold", 2, 90e-9),
      RowOf("EVPOST to EVWAIT", "hold", 2, 50e-9),
      RowOf("BARSYNC", "block", 2, 9e-6),
      RowOf("futex wake to running", "Linux", 2, 3e-6),
      RowOf("BARSYNC", "logical", 2, 120e-9),
      RowOf("BARSYNC", "logical", 4, 140e-9),
      RowOf("BARSYNC", "logical", 16, 260e-9),
  };
  const auto waits =
      FitWaits(rows, Distance::kNear, 40e-9, 2, std::chrono::microseconds(50));
  const WaitCost& hold = waits.at(WaitKind::kHold);
  EXPECT_DOUBLE_EQ(hold.barrier.two, 70e-9);  // hold and spin as one
  EXPECT_DOUBLE_EQ(hold.barrier.further, 40e-9);
  EXPECT_DOUBLE_EQ(*hold.barrier.round, 90e-9);
  EXPECT_FALSE(hold.barrier.level.has_value());
  EXPECT_DOUBLE_EQ(hold.event, 50e-9);
  EXPECT_DOUBLE_EQ(hold.wake, 9e-6);
  EXPECT_DOUBLE_EQ(hold.waker, 3e-6);
  EXPECT_DOUBLE_EQ(hold.sleeps_after, 50e-6);
  EXPECT_LT(waits.at(WaitKind::kBlock).sleeps_after, 5e-6);
  EXPECT_EQ(waits.at(WaitKind::kSpin).sleeps_after, kNever);
  // 4 and 16 tasks on 2 processors: 10 ns a task, and 100 ns.
  const WaitCost& logical = waits.at(WaitKind::kLogical);
  EXPECT_NEAR(logical.turn, 20e-9, 1e-15);
  EXPECT_NEAR(logical.shared_wake, 100e-9, 1e-15);
}

TEST(FitWaits, TakesAMissingRowFromTheOtherDistance) {
  const auto waits =
      FitWaits({RowOf("BARSYNC, counter", "hold", 2, 60e-9)}, Distance::kFar,
               40e-9, 2, std::chrono::microseconds(50));
  EXPECT_DOUBLE_EQ(waits.at(macrotask::WaitKind::kHold).barrier.two, 60e-9);
}

}  // namespace
}  // namespace bench::predict
