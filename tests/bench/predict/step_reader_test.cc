#include "bench/predict/step_reader.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include "bench/predict/marks.h"
#include "tests/bench/predict/print_step.h"
#include "tests/bench/trace_example.h"

namespace bench::predict {

namespace {

using enum macrotask::TraceAction;
using enum StepKind;
using Steps = std::vector<Step>;

constexpr auto kMark = static_cast<Action>(kMarkAction);

// Task 1 has index 0, task 2 index 1; a tick is a second.
StepReader Reader(double record_seconds = 0) {
  return StepReader(1, record_seconds, {{1, 0}, {2, 1}});
}

Steps Read(const Script& script, double record_seconds = 0) {
  return Reader(record_seconds).Read(script.Buffer().records);
}

Step Other(double seconds) { return Compute(Block::kOther, seconds); }

std::string WhyNot(const StepReader& reader) {
  Program program;
  try {
    reader.TakeObjects(&program);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

TEST(StepReader, TaskWithoutRecordsHasNoSteps) {
  EXPECT_EQ(Read(Script(1)), Steps());
}

TEST(StepReader, ComputesBetweenRecordsThatAreNoCalls) {
  const auto user = static_cast<Action>(70);
  Script one(1);
  one.At(10, kTraceClasses, 63)
      .At(11, kTaskBegin, 5)
      .At(13, user, 2)
      .At(16, kTune, Data(50, 4))
      .At(20, kTaskEnd);
  EXPECT_EQ(Read(one), (Steps{Other(1), Other(2), Other(3), Other(4)}));
}

TEST(StepReader, ComputesAlsoForNoTimeAtAll) {
  Script one(1);
  one.At(10, kEventPost, Data(1)).At(10, kEventClear, Data(1));
  EXPECT_EQ(Read(one), (Steps{Sync(kPost, 0), Other(0), Sync(kClear, 0)}));
}

TEST(StepReader, ComputesWithoutTheTimeOfTheRecordButNeverLessThanNothing) {
  Script one(1);
  one.At(10, kEventPost, Data(1))
      .At(15, kEventPost, Data(1))
      .At(16, kEventPost, Data(1));
  EXPECT_EQ(Read(one, 2), (Steps{Sync(kPost, 0), Other(3), Sync(kPost, 0),
                                 Other(0), Sync(kPost, 0)}));
}

TEST(StepReader, TellsSecondsByTheTicksOfTheTrace) {
  Script one(1);
  one.At(1000, kTaskBegin).At(1500, kTaskEnd);
  StepReader reader(250, 0, {});
  EXPECT_EQ(reader.Read(one.Buffer().records), Steps{Other(2)});
}

TEST(StepReader, MarkNamesTheBlockUntilTheNextRecord) {
  Script one(1);
  one.At(10, kMark, static_cast<std::uint64_t>(Block::kOcd))
      .At(14, kMark, static_cast<std::uint64_t>(Block::kCcd))
      .At(19, kEventPost, Data(1))
      .At(25, kTaskEnd);
  EXPECT_EQ(Read(one), (Steps{Compute(Block::kOcd, 4), Compute(Block::kCcd, 5),
                              Sync(kPost, 0), Other(6)}));
}

TEST(StepReader, MarkOfNoBlockNamesNone) {
  Script one(1);
  one.At(10, kMark, kNumBlocks).At(14, kTaskEnd);
  EXPECT_EQ(Read(one), Steps{Other(4)});
}

TEST(StepReader, EveryCallIsAStep) {
  Script one(1);
  one.Wait(10, 11, kBarrierSync, Data(3, 2))
      .At(12, kEventPost, Data(3))
      .Wait(13, 14, kEventWait, Data(3))
      .At(15, kEventClear, Data(3))
      .Wait(16, 17, kLockOn, Data(3))
      .At(18, kLockOff, Data(3))
      .At(19, kTaskStart, Data(2))
      .Wait(20, 21, kTaskWait, Data(2));
  const Step second = Other(1);
  EXPECT_EQ(Read(one), (Steps{Sync(kBarrier, 0), second, Sync(kPost, 0), second,
                              Sync(kWait, 0), second, Sync(kClear, 0), second,
                              Sync(kLock, 0), second, Sync(kUnlock, 0), second,
                              Sync(kStart, 1), second, Sync(kJoin, 1)}));
}

TEST(StepReader, CallsOnUnknownTasksAreNoStepsAndTheirWaitsNoComputing) {
  Script one(1);
  one.At(10, kTaskStart, Data(7))
      .Wait(12, 20, kTaskWait, Data(7))
      .At(23, kTaskEnd);
  EXPECT_EQ(Read(one), (Steps{Other(2), Other(3)}));
}

TEST(StepReader, TestsOfTasksAreNoSteps) {
  Script one(1);
  one.At(10, kTaskTest, Data(2, 1)).At(15, kTaskTest, Data(2));
  EXPECT_EQ(Read(one), Steps{Other(5)});
}

TEST(StepReader, AssigningAndReleasingAreNoSteps) {
  Script one(1);
  one.At(10, kLockAssign, Data(1))
      .At(11, kEventAssign, Data(1))
      .At(12, kBarrierAssign, Data(1, 2))
      .At(13, kLockRelease, Data(1))
      .At(14, kEventRelease, Data(1))
      .At(15, kBarrierRelease, Data(1));
  EXPECT_EQ(Read(one),
            (Steps{Other(1), Other(1), Other(1), Other(1), Other(1)}));
}

TEST(StepReader, EvasgnAgainIsAClear) {
  Script one(1), two(2);
  one.At(10, kEventAssign, Data(4)).At(11, kEventAssign, Data(4));
  two.At(12, kEventAssign, Data(4)).At(13, kEventAssign, Data(5));
  StepReader reader = Reader();
  EXPECT_EQ(reader.Read(one.Buffer().records),
            (Steps{Other(1), Sync(kClear, 0)}));
  EXPECT_EQ(reader.Read(two.Buffer().records),
            (Steps{Sync(kClear, 0), Other(1)}));
}

TEST(StepReader, EvclearOfAnEvasgnIsPartOfIt) {
  Script one(1);
  one.At(10, kEventAssign, Data(4))
      .At(11, kEventClear, Data(4))
      .At(13, kEventClear, Data(4))  // the program's own
      .At(16, kEventAssign, Data(4))
      .At(17, kEventClear, Data(4))
      .At(21, kEventAssign, Data(5))
      .At(22, kEventClear, Data(4));  // of another event
  EXPECT_EQ(Read(one),
            (Steps{Other(2), Sync(kClear, 0), Other(3), Sync(kClear, 0),
                   Other(4), Other(1), Sync(kClear, 0)}));
}

TEST(StepReader, TestsInVainBeforeOneThatSucceedsAreTheWait) {
  Script one(1);
  one.At(10, kTaskBegin)
      .At(12, kLockTestSet, Data(1, 40))
      .At(20, kLockTestOn, Data(1))
      .At(23, kLockOff, Data(1))
      .At(27, kEventTestClear, Data(1, 3))
      .At(30, kEventTestClear, Data(1, 2))
      .At(39, kEventTest, Data(1, 1))
      .At(44, kTaskEnd);
  EXPECT_EQ(Read(one),
            (Steps{Other(2), Sync(kLock, 0), Other(3), Sync(kUnlock, 0),
                   Other(4), Sync(kWait, 0), Other(5)}));
}

TEST(StepReader, TestThatSucceedsAtOnceIsAWait) {
  Script one(1);
  one.At(10, kLockTestOn, Data(1)).At(12, kEventTest, Data(1, 5));
  EXPECT_EQ(Read(one), (Steps{Sync(kLock, 0), Other(2), Sync(kWait, 0)}));
}

TEST(StepReader, TestsInVainAreComputing) {
  Script one(1);
  one.At(10, kLockTestSet, Data(1, 40))
      .At(12, kLockTestOn, Data(2))  // another lock
      .At(15, kEventTestClear, Data(1, 3))
      .At(19, kEventPost, Data(2))  // anything else
      .At(24, kEventTest, Data(1, 1))
      .At(30, kEventTestClear, Data(1, 3))
      .At(37, kEventTestClear, Data(2, 3))
      .At(45, kEventTest, Data(1, 1))
      .At(54, kLockTestSet, Data(1, 40));
  // Events are met in the order 1, 2 and locks in the order 1, 2.
  EXPECT_EQ(Read(one),
            (Steps{Other(2), Sync(kLock, 1), Other(3), Other(4), Sync(kPost, 1),
                   Other(5), Sync(kWait, 0), Other(6), Other(7), Other(8),
                   Sync(kWait, 0), Other(9)}));
}

TEST(StepReader, SleepsInsideAWaitArePartOfIt) {
  Script one(1);
  one.At(10, kBarrierSync, Data(3, 2))
      .At(11, kSleep)
      .At(12, kWake)
      .At(13, kSleep)
      .At(18, kWake)
      .At(20, kBarrierSyncEnd, Data(3))
      .At(25, kTaskEnd);
  EXPECT_EQ(Read(one), (Steps{Sync(kBarrier, 0), Other(5)}));
}

TEST(StepReader, SleepOutsideOfAWaitIsNoComputing) {
  Script one(1);
  one.At(10, kTaskBegin).At(12, kSleep).At(20, kWake).At(23, kTaskEnd);
  EXPECT_EQ(Read(one), (Steps{Other(2), Other(3)}));
}

TEST(StepReader, WaitThatHasNotEndedIsAStep) {
  Script one(1), two(2);
  one.At(10, kTaskBegin).At(12, kEventWait, Data(1));
  EXPECT_EQ(Read(one), (Steps{Other(2), Sync(kWait, 0)}));
  two.At(12, kBarrierSync, Data(1, 2))
      .At(14, kSleep)
      .At(16, kWake)
      .At(18, kSleep);
  EXPECT_EQ(Read(two), Steps{Sync(kBarrier, 0)});
}

TEST(StepReader, WaitWhoseEndIsLostIsAStep) {
  Script one(1);
  one.At(10, kLockOn, Data(1)).At(15, kLockOff, Data(1)).At(18, kTaskEnd);
  EXPECT_EQ(Read(one), (Steps{Sync(kLock, 0), Sync(kUnlock, 0), Other(3)}));
}

TEST(StepReader, NothingFollowsTheEndOfATask) {
  Script two(2);
  two.At(10, kTaskBegin).At(15, kTaskEnd).At(16, kSleep).At(80, kWake);
  EXPECT_EQ(Read(two), Steps{Other(5)});
}

TEST(StepReader, ObjectsHaveIndicesInTheOrderInWhichTheyAreMet) {
  Script one(1), two(2);
  one.Wait(10, 11, kBarrierSync, Data(9, 3))
      .At(12, kLockTestSet, Data(9, 1))
      .At(13, kEventPost, Data(8));
  two.Wait(10, 11, kBarrierSync, Data(4, 2))
      .Wait(12, 13, kBarrierSync, Data(9, 3))
      .At(14, kLockTestOn, Data(2))
      .At(15, kEventPost, Data(3))
      .At(16, kBarrierAssign, Data(1, 7));
  StepReader reader = Reader();
  reader.Read(one.Buffer().records);
  EXPECT_EQ(reader.Read(two.Buffer().records),
            (Steps{Sync(kBarrier, 1), Other(1), Sync(kBarrier, 0), Other(1),
                   Sync(kLock, 1), Other(1), Sync(kPost, 1), Other(1)}));
  Program program;
  reader.TakeObjects(&program);
  EXPECT_EQ(program.barriers, (std::vector<int>{3, 2, 7}));
  EXPECT_EQ(program.num_events, 2);
  EXPECT_EQ(program.num_locks, 2);
}

TEST(StepReader, ReleasingMeetsNothing) {
  Script one(1);
  one.At(10, kBarrierRelease, Data(1))
      .At(11, kEventRelease, Data(1))
      .At(12, kLockRelease, Data(1));
  StepReader reader = Reader();
  reader.Read(one.Buffer().records);
  Program program;
  reader.TakeObjects(&program);
  EXPECT_TRUE(program.barriers.empty());
  EXPECT_EQ(program.num_events, 0);
  EXPECT_EQ(program.num_locks, 0);
}

TEST(StepReader, BarrierHasOneNumberOfTasks) {
  Script one(1), two(2);
  one.At(10, kBarrierAssign, Data(5, 3)).Wait(11, 20, kBarrierSync, Data(5, 3));
  two.Wait(12, 20, kBarrierSync, Data(5, 2));
  StepReader reader = Reader();
  reader.Read(one.Buffer().records);
  EXPECT_EQ(WhyNot(reader), "");
  reader.Read(two.Buffer().records);
  EXPECT_EQ(WhyNot(reader),
            "barrier 5 is of 2 tasks and of 3: expected one number of tasks");
}

}  // namespace
}  // namespace bench::predict
