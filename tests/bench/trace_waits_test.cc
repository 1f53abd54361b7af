#include "bench/trace_waits.h"

#include <gtest/gtest.h>

#include "tests/bench/trace_example.h"

namespace bench {
namespace {

using enum macrotask::TraceAction;

std::vector<TraceWait> WaitsOf(
    const std::vector<macrotask::TraceBuffer>& buffers) {
  return PairWaits(InOrderOfTime(TraceOf(buffers)), 1100);
}

TraceWait Barrier3(std::uint32_t task, std::uint64_t begin, std::uint64_t end) {
  return {kBarrierSync,
          {macrotask::ObjectKind::kBarrier, 3},
          task,
          begin,
          end,
          true,
          0};
}

TEST(PairWaits, FindsTheEndOfEveryTasksWait) {
  Script one(1), two(2);
  one.Wait(1010, 1030, kBarrierSync, Data(3, 2));
  two.Wait(1020, 1031, kBarrierSync, Data(3, 2))
      .Wait(1040, 1050, kLockOn, Data(3));
  const std::vector<TraceWait> expected = {
      Barrier3(1, 1010, 1030),
      Barrier3(2, 1020, 1031),
      {kLockOn, {macrotask::ObjectKind::kLock, 3}, 2, 1040, 1050, true, 0}};
  EXPECT_EQ(WaitsOf({one.Buffer(), two.Buffer()}), expected);
}

TEST(PairWaits, WaitInsideAWaitIsDeeper) {
  Script one(1);
  one.At(1010, kBarrierSync, Data(3, 2))
      .At(1011, kSleep)
      .At(1012, kWake)
      .At(1012, kSleep)
      .At(1019, kWake)
      .At(1020, kBarrierSyncEnd, Data(3))
      .At(1020, kSleep)
      .At(1021, kWake);
  const std::vector<TraceWait> expected = {
      Barrier3(1, 1010, 1020),
      {kSleep, {}, 1, 1011, 1012, true, 1},
      {kSleep, {}, 1, 1012, 1019, true, 1},
      {kSleep, {}, 1, 1020, 1021, true, 0}};
  EXPECT_EQ(WaitsOf({one.Buffer()}), expected);
}

TEST(PairWaits, UnfinishedWaitsLastToTheEndOfTheTrace) {
  Script one(1);
  one.At(1010, kEventWait, Data(1)).At(1012, kSleep);
  const std::vector<TraceWait> expected = {
      {kEventWait, {macrotask::ObjectKind::kEvent, 1}, 1, 1010, 1100, false, 0},
      {kSleep, {}, 1, 1012, 1100, false, 1}};
  EXPECT_EQ(WaitsOf({one.Buffer()}), expected);
}

TEST(PairWaits, EndWithoutBeginningIsLeftOut) {
  Script one(1);
  one.At(1005, kWake)
      .At(1006, kBarrierSyncEnd, Data(3))
      .Wait(1010, 1020, kBarrierSync, Data(3, 2))
      .At(1030, kBarrierSyncEnd, Data(3));
  EXPECT_EQ(WaitsOf({one.Buffer(4)}),
            std::vector<TraceWait>{Barrier3(1, 1010, 1020)});
}

TEST(PairWaits, EndOfAnotherTaskOrObjectEndsNothing) {
  Script one(1), two(2);
  one.At(1010, kBarrierSync, Data(3, 2))
      .At(1012, kBarrierSyncEnd, Data(4))
      .At(1013, kEventWaitEnd, Data(3));
  two.At(1011, kBarrierSyncEnd, Data(3));
  const auto waits = WaitsOf({one.Buffer(), two.Buffer()});
  ASSERT_EQ(waits.size(), 1u);
  EXPECT_FALSE(waits[0].finished);
}

TEST(PairWaits, BeginningWhoseEndWasNotRecordedIsLeftOut) {
  Script again(1), ended(2), around(3), slept(4);
  again.At(1010, kBarrierSync, Data(3, 2))
      .Wait(1020, 1030, kBarrierSync, Data(3, 2));
  ended.At(1010, kLockOn, Data(3)).At(1020, kTaskEnd);
  around.At(1040, kBarrierSync, Data(3, 2))
      .At(1041, kLockOn, Data(3))
      .At(1050, kBarrierSyncEnd, Data(3));
  slept.At(1060, kSleep).At(1070, kEventPost, Data(1));
  EXPECT_EQ(WaitsOf({again.Buffer(), ended.Buffer(), around.Buffer(),
                     slept.Buffer()}),
            (std::vector<TraceWait>{Barrier3(1, 1020, 1030),
                                    Barrier3(3, 1040, 1050)}));
}

TEST(PairWaits, PthreadThatSleepsBetweenTasksIsNoWait) {
  Script one(1);
  one.At(1010, kTaskEnd).At(1020, kSleep);
  EXPECT_TRUE(WaitsOf({one.Buffer()}).empty());
}

}  // namespace
}  // namespace bench
