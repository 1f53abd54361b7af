#include <gtest/gtest.h>

#include "bench/predict/simulation.h"
#include "tests/bench/predict/programs.h"

namespace bench::predict {
namespace {

// --- Barriers ----------------------------------------------------------------

TEST(Simulate, EqualPhasesTakeTheirWorkAndTheirBarrierEach) {
  const WaitCost wait = {.barrier = {.two = 0.25, .further = 0.125}};
  for (const int n : kTaskCounts) {
    const auto result = Simulated(Phases(n, 5, 1), On(n, wait));
    const double cost = n == 1 ? 0 : 0.25 + 0.125 * (n - 2);
    EXPECT_EQ(result.seconds, 5 * (1 + cost)) << n;
    for (std::size_t t = 0; t < result.tasks.size(); ++t) {
      EXPECT_EQ(Of(result, t), (Times{5, 0, 5 * cost, 0, 0})) << n;
    }
  }
}

TEST(Simulate, BarrierCostIsThatOfItsOwnTasksAndNotOfAll) {
  const WaitCost wait = {.barrier = {.two = 0.25, .further = 8}};
  const auto result =
      Simulated(Tasks({{Barrier()}, {Busy(1), Barrier()}, {}}, 2), On(3, wait));
  EXPECT_EQ(result.seconds, 1.25);
}

TEST(Simulate, WhoeverComesEarlyHasTheImbalance) {
  const WaitCost wait = {.barrier = {.two = 0.25, .further = 0.125}};
  const auto result = Simulated(
      Tasks({{Busy(1), Barrier()}, {Busy(4), Barrier()}, {Busy(2), Barrier()}}),
      On(3, wait));
  EXPECT_EQ(Of(result, 0), (Times{1, 3, 0.375, 0, 0}));
  EXPECT_EQ(Of(result, 1), (Times{4, 0, 0.375, 0, 0}));
  EXPECT_EQ(Of(result, 2), (Times{2, 2, 0.375, 0, 0}));
}

TEST(Simulate, BarrierOfOneTaskCostsNothing) {
  const WaitCost wait = {.barrier = {.two = 8, .further = 8}};
  const auto result = Simulated(
      Tasks({{Barrier(), Busy(1), Barrier()}, {Busy(1)}}, 1), On(2, wait));
  EXPECT_EQ(Of(result, 0), (Times{1, 0, 0, 0, 0}));
}

// --- Events ------------------------------------------------------------------

TEST(Simulate, TasksThatAlternateTakeTheSumOfTheirTurns) {
  Program program = Tasks({{}, {}});
  program.tasks[0] = {{}, {Busy(1), Post(0), Wait(1), Clear(1)}, {}, 7};
  program.tasks[1] = {{}, {Wait(0), Clear(0), Busy(0.5), Post(1)}, {}, 7};
  const auto result = Simulated(
      program, On(2, {.barrier = {}, .event = 0.125, .post = 0.0625}));
  EXPECT_EQ(result.seconds, 7 * (1.5 + 2 * 0.125 + 2 * 0.0625));
  EXPECT_EQ(Of(result, 0), (Times{7, 7 * 0.625, 7 * 0.25, 0, 0}));
  EXPECT_EQ(result.tasks[1].absent, 0.125);  // its last post is under way
}

TEST(Simulate, WaitForAnEventThatWasPostedLongAgoPassesAtOnce) {
  const auto result =
      Simulated(Tasks({{Post(0)}, {Busy(1), Wait(0), Busy(1), Wait(0)}}),
                On(2, {.barrier = {}, .event = 1}));
  EXPECT_EQ(Of(result, 1), (Times{2, 0, 0, 0, 0}));
}

TEST(Simulate, WaitForAnEventThatWasJustPostedEndsWhenThatIsKnown) {
  const auto result =
      Simulated(Tasks({{Busy(1), Post(0), Busy(4)},
                       {Busy(1.25), Wait(0), Wait(0), Busy(0.25), Wait(0)},
                       {Wait(0)}}),
                On(3, {.barrier = {}, .event = 0.5}));
  EXPECT_EQ(Of(result, 0), (Times{5, 0, 0, 0, 0}));
  EXPECT_EQ(Of(result, 1), (Times{1.5, 0, 0.25, 0, 3.25}));
  EXPECT_EQ(End(result, 2), 1.5);  // no sooner than whoever comes later
}

// Not even `wake`: whoever finds the event posted does not fall asleep.
TEST(Simulate, WaitForAnEventThatWasJustPostedWakesNobody) {
  const auto result =
      Simulated(Tasks({{Busy(4), Post(0)}, {Busy(4.0625), Wait(0)}}),
                On(2, {.barrier = {},
                       .event = 0.5,
                       .sleeps_after = 0,
                       .wake = 8,
                       .waker = 8}));
  EXPECT_EQ(Of(result, 0), (Times{4, 0, 0, 0, 0.5}));
  EXPECT_EQ(Of(result, 1), (Times{4.0625, 0, 0.4375, 0, 0}));
}

TEST(Simulate, EventThatWasClearedIsPostedAnew) {
  const auto result = Simulated(
      Tasks({{Post(0), Clear(0), Busy(2), Post(0)}, {Busy(2.25), Wait(0)}}),
      On(2, {.barrier = {}, .event = 0.5}));
  EXPECT_EQ(Of(result, 1), (Times{2.25, 0, 0.25, 0, 0}));
}

TEST(Simulate, SecondPostOfAPostedEventTellsNothingNew) {
  const auto result =
      Simulated(Tasks({{Post(0), Busy(2), Post(0)}, {Busy(2.25), Wait(0)}}),
                On(2, {.barrier = {}, .event = 0.5}));
  EXPECT_EQ(Of(result, 1), (Times{2.25, 0, 0, 0, 0}));
}

TEST(Simulate, PostLetsAllWaitersGoWhileItStillCostsItsCaller) {
  const auto result =
      Simulated(Tasks({{Busy(1), Post(0)}, {Wait(0)}, {Wait(0)}}),
                On(3, {.barrier = {}, .event = 0.25, .post = 2}));
  EXPECT_EQ(Of(result, 0), (Times{1, 0, 2, 0, 0}));
  EXPECT_EQ(Of(result, 1), (Times{0, 1, 0.25, 0, 1.75}));
  EXPECT_EQ(Of(result, 2), (Times{0, 1, 0.25, 0, 1.75}));
}

TEST(Simulate, ClearedEventHoldsUntilItIsPostedAgain) {
  const auto result = Simulated(
      Tasks({{Post(0), Clear(0), Busy(2), Post(0)}, {Busy(1), Wait(0)}}),
      On(2));
  EXPECT_EQ(Of(result, 1), (Times{1, 1, 0, 0, 0}));
}

TEST(Simulate, ClearDoesNotReachWhoeverHasBeenLetGo) {
  const auto result =
      Simulated(Tasks({{Busy(1), Post(0), Clear(0)}, {Wait(0)}}),
                On(2, {.barrier = {}, .event = 0.5, .post = 0.125}));
  EXPECT_EQ(Of(result, 0), (Times{1, 0, 0.25, 0, 0.25}));
  EXPECT_EQ(End(result, 1), 1.5);
}

// --- Locks -------------------------------------------------------------------

TEST(Simulate, LockGoesToWhoeverHasWaitedLongest) {
  Program program = Tasks({{}, {}, {}, {}});
  for (int t = 0; t < 4; ++t) {  // the last one comes first
    program.tasks[static_cast<std::size_t>(t)].head = {Busy(4 - t), LockOn(),
                                                       Busy(8), LockOff()};
  }
  const auto result = Simulated(program, On(4, {.barrier = {}, .lock = 0.5}));
  EXPECT_EQ(Of(result, 3), (Times{9, 0, 0, 0, 25.5}));
  EXPECT_EQ(Of(result, 2), (Times{10, 7, 0.5, 0, 17}));
  EXPECT_EQ(Of(result, 1), (Times{11, 14.5, 0.5, 0, 8.5}));
  EXPECT_EQ(Of(result, 0), (Times{12, 22, 0.5, 0, 0}));
}

TEST(Simulate, LockThatNobodyHoldsCostsNothing) {
  const auto result =
      Simulated(Tasks({{LockOn(), Busy(1), LockOff(), LockOn(), LockOff()},
                       {Busy(2), LockOn(), Busy(1), LockOff()}}),
                On(2, {.barrier = {}, .lock = 8}));
  EXPECT_EQ(Of(result, 0), (Times{1, 0, 0, 0, 2}));
  EXPECT_EQ(Of(result, 1), (Times{3, 0, 0, 0, 0}));
}

TEST(Simulate, LockThatIsHandedOnIsNotFreeInBetween) {
  const auto result = Simulated(Tasks({{LockOn(), Busy(1), LockOff(), LockOn()},
                                       {LockOn(), Busy(2), LockOff()}}),
                                On(2, {.barrier = {}, .lock = 0.5}));
  EXPECT_EQ(Of(result, 0), (Times{1, 2.5, 0.5, 0, 0}));
}

// --- Sleepers ----------------------------------------------------------------

TEST(Simulate, SleeperReturnsLateAndCostsItsWaker) {
  const auto result = Simulated(Tasks({{Busy(4), Post(0), Busy(1)}, {Wait(0)}}),
                                On(2, kSleepy));
  EXPECT_EQ(Of(result, 0), (Times{4 + 1, 0, 0.25, 0, 0}));
  EXPECT_EQ(Of(result, 1), (Times{0, 4, 0.5, 0, 0.75}));
}

TEST(Simulate, WaitThatLastsNoLongerThanSleepsAfterDoesNotSleep) {
  const auto result = Simulated(Tasks({{Busy(2), Post(0), Busy(1)}, {Wait(0)}}),
                                On(2, kSleepy));
  EXPECT_EQ(Of(result, 0), (Times{3, 0, 0, 0, 0}));
  EXPECT_EQ(Of(result, 1), (Times{0, 2, 0.125, 0, 0.875}));
}

TEST(Simulate, WakerOfManyPaysOnce) {
  const auto result = Simulated(
      Tasks({{Busy(4), Post(0)}, {Wait(0)}, {Wait(0)}}), On(3, kSleepy));
  EXPECT_EQ(Of(result, 0), (Times{4, 0, 0.25, 0, 0.25}));
}

TEST(Simulate, UnlockPaysForASleeper) {
  const auto result = Simulated(
      Tasks({{LockOn(), Busy(4), LockOff()}, {LockOn()}}), On(2, kSleepy));
  EXPECT_EQ(Of(result, 0), (Times{4, 0, 0.25, 0, 0.25}));
  EXPECT_EQ(Of(result, 1), (Times{0, 4, 0.5, 0, 0}));
}

TEST(Simulate, TaskThatEndsPaysForAJoinerThatSleeps) {
  const auto result = Simulated(Tasks({{Busy(4)}, {Join(0)}}), On(2, kSleepy));
  EXPECT_EQ(Of(result, 0), (Times{4, 0, 0.25, 0, 0.25}));
  EXPECT_EQ(Of(result, 1), (Times{0, 4, 0.5, 0, 0}));
}

TEST(Simulate, SleepersAtABarrierReturnAfterThoseThatSpin) {
  for (const double waker : {0.25, 0.0}) {
    WaitCost wait = kSleepy;
    wait.waker = waker;
    const auto result = Simulated(
        Tasks({{Barrier()}, {Busy(3), Barrier()}, {Busy(4), Barrier()}}),
        On(3, wait));
    EXPECT_EQ(End(result, 0), 4.5);
    EXPECT_EQ(End(result, 1), 4.125);
    EXPECT_EQ(End(result, 2), 4 + waker);
  }
}

}  // namespace
}  // namespace bench::predict
