#include "bench/trace_sync.h"

#include <gtest/gtest.h>

#include "tests/bench/trace_example.h"

namespace bench {
namespace {

using enum macrotask::TraceAction;

TEST(FindWakes, PairAWaitWithTheFirstPostDuringIt) {
  Script one(1), two(2);
  one.Wait(1010, 1030, kEventWait, Data(1))
      .Wait(1040, 1041, kEventWait, Data(1))   // posted already
      .Wait(1050, 1070, kEventWait, Data(2));  // of another event
  two.At(1020, kEventPost, Data(1))
      .At(1025, kEventPost, Data(1))
      .At(1060, kEventPost, Data(1));
  const auto wakes = FindWakes(HistoryOf({one.Buffer(), two.Buffer()}));
  ASSERT_EQ(wakes.size(), 1u);
  EXPECT_EQ(wakes[0].wait.begin, 1010u);
  EXPECT_EQ(wakes[0].post.clock, 1020u);
  EXPECT_EQ(wakes[0].post.task, 2u);
}

TEST(FindHolds, SayHowLongOthersWaitMeanwhile) {
  Script one(1), two(2);
  one.Wait(1010, 1010, kLockOn, Data(1)).At(1040, kLockOff, Data(1));
  two.Wait(1025, 1042, kLockOn, Data(1)).At(1050, kLockOff, Data(1));
  EXPECT_EQ(
      FindHolds(HistoryOf({one.Buffer(), two.Buffer()})),
      (std::vector<LockHold>{{1, 1, 1010, 1040, 15}, {1, 2, 1042, 1050, 0}}));
}

TEST(FindHolds, BeginWithLocktestAndEndWithAnyonesLockoff) {
  Script one(1), two(2);
  one.At(1010, kLockTestOn, Data(1));
  two.At(1005, kLockOff, Data(1))  // held since before the trace
      .At(1020, kLockOff, Data(1))
      .At(1030, kLockTestOn, Data(1));  // until the end of the trace
  EXPECT_EQ(
      FindHolds(HistoryOf({one.Buffer(), two.Buffer()})),
      (std::vector<LockHold>{{1, 1, 1010, 1020, 0}, {1, 2, 1030, 1100, 0}}));
}

TEST(FindHolds, NextHoldersRecordMayBeOlderThanTheLockoff) {
  Script one(1), two(2);
  one.At(1010, kLockTestOn, Data(1)).At(1021, kLockOff, Data(1));
  two.At(1020, kLockTestOn, Data(1)).At(1030, kLockOff, Data(1));
  EXPECT_EQ(
      FindHolds(HistoryOf({one.Buffer(), two.Buffer()})),
      (std::vector<LockHold>{{1, 1, 1010, 1021, 0}, {1, 2, 1020, 1030, 0}}));
}

}  // namespace
}  // namespace bench
