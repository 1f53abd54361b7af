#include "bench/sync_hold_time.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace bench {
namespace {

TEST(CalcHoldTime, IsTwiceWhatSleepingAdds) {
  const HoldTime hold_time =
      CalcHoldTime({.asleep = {20.1e-6, 24.1e-6, 22.1e-6},
                    .spinning = {0.1e-6, 0.1e-6, 0.1e-6}});
  EXPECT_DOUBLE_EQ(hold_time.cost.median, 22e-6);
  EXPECT_NEAR(hold_time.recommended, 44e-6, 1e-12);
  EXPECT_EQ(hold_time.cost.n, 3);
  EXPECT_EQ(hold_time.dropped, 0);
}

TEST(CalcHoldTime, IsInWholeMicrosecondsNeverNone) {
  EXPECT_NEAR(
      CalcHoldTime({.asleep = {0.3e-6}, .spinning = {0.1e-6}}).recommended,
      1e-6, 1e-12);
  EXPECT_NEAR(
      CalcHoldTime({.asleep = {10.3e-6}, .spinning = {0.1e-6}}).recommended,
      21e-6, 1e-12);
}

TEST(CalcHoldTime, DropsPairsInWhichSleepingWasFaster) {
  const HoldTime hold_time = CalcHoldTime(
      {.asleep = {1e-6, 21e-6, 1e-6}, .spinning = {300e-6, 1e-6, 2e-6}});
  EXPECT_EQ(hold_time.dropped, 2);
  EXPECT_DOUBLE_EQ(hold_time.cost.median, 20e-6);
}

TEST(CalcHoldTime, RefusesAMachineThatNeverSleepsInVain) {
  EXPECT_THROW(CalcHoldTime({.asleep = {1e-6}, .spinning = {2e-6}}),
               std::runtime_error);
}

}  // namespace
}  // namespace bench
