#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>
#include <string>

#include "bench/predict/simulation.h"
#include "tests/bench/predict/programs.h"

namespace bench::predict {
namespace {

std::string WhyForEver(const Program& program) {
  try {
    Simulate(program, On(4));
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "it ends";
}

// --- Steps -------------------------------------------------------------------

TEST(Simulate, TaskAloneComputesAndNothingElse) {
  const auto result = Simulated(Tasks({{Busy(2), Busy(0), Busy(0.5)}}), On(1));
  EXPECT_EQ(result.seconds, 2.5);
  EXPECT_EQ(Of(result, 0), (Times{2.5, 0, 0, 0, 0}));
}

TEST(Simulate, NoTasksTakeNoTime) {
  const auto result = Simulated({}, On(2));
  EXPECT_EQ(result.seconds, 0);
  EXPECT_TRUE(result.tasks.empty());
}

TEST(Simulate, TaskWithoutStepsIsAbsent) {
  const auto result = Simulated(Tasks({{}, {Busy(1)}}), On(2));
  EXPECT_EQ(Of(result, 0), (Times{0, 0, 0, 0, 1}));
}

// The posts of the task in front show when it is through its head and tail.
TEST(Simulate, RunsHeadThenBodiesThenTail) {
  for (const long turns : {0, 1, 3}) {
    Program program = Tasks({{}, {Wait(0)}, {Wait(1)}});
    program.tasks[0] = {
        {Busy(1), Post(0)}, {Busy(2), Busy(8)}, {Busy(4), Post(1)}, turns};
    const auto result = Simulated(program, On(3));
    EXPECT_EQ(End(result, 1), 1) << turns;
    EXPECT_EQ(End(result, 2), 5 + 10 * static_cast<double>(turns)) << turns;
    EXPECT_EQ(result.tasks[0].compute, Work(program)) << turns;
  }
}

TEST(Simulate, BodyComesInTheOrderOfItsStepsInEachTurn) {
  Program program = Tasks({{}, {}});
  program.tasks[0] = {{}, {Busy(1), Barrier(), Busy(2), Barrier()}, {}, 3};
  program.tasks[1] = {{}, {Busy(4), Barrier(), Busy(1), Barrier()}, {}, 3};
  const auto result = Simulated(program, On(2));
  EXPECT_EQ(Of(result, 0), (Times{9, 9, 0, 0, 0}));
  EXPECT_EQ(Of(result, 1), (Times{15, 3, 0, 0, 0}));
}

TEST(Simulate, EmptyBodyTakesNoTimeHoweverOften) {
  for (const long turns : {0L, 1L, 3L, std::numeric_limits<long>::max()}) {
    Program program = Tasks({{}});
    program.tasks[0] = {{Busy(1)}, {}, {Busy(2)}, turns};
    EXPECT_EQ(Simulated(program, On(1)).seconds, 3);
    program.tasks[0] = {{}, {}, {}, turns};
    EXPECT_EQ(Simulated(program, On(1)).seconds, 0);
  }
}

// --- Start and join ----------------------------------------------------------

Program ForkJoin() {
  return Started({{Busy(1), Start(1), Start(2), Start(3), Busy(2), Join(1),
                   Join(2), Join(3), Busy(1)},
                  {Busy(4)},
                  {Busy(4)},
                  {Busy(4)}});
}

TEST(Simulate, StartedTasksRunBesideTheirStarterAndEndBeforeItsJoin) {
  const auto result = Simulated(
      ForkJoin(), On(4, {.barrier = {}, .event = 0.125, .start = 0.25}));
  EXPECT_EQ(result.seconds, 1 + 0.25 + 4 + 0.125 + 1);
  EXPECT_EQ(Of(result, 0), (Times{4, 2.25, 0.125, 0, 0}));
  for (const std::size_t t : {1u, 2u, 3u}) {
    EXPECT_EQ(Of(result, t), (Times{4, 0, 0, 0, 2.375})) << t;
  }
}

TEST(Simulate, StartedTasksQueueOnOneProcessorWithTheirStarter) {
  const auto result = Simulated(
      ForkJoin(),
      On(1, {.barrier = {}, .event = 8, .start = 0.25, .turn = 0.125}));
  EXPECT_EQ(result.seconds, 4 + 3 * 4 + 4 * 0.125);
  EXPECT_EQ(Of(result, 0), (Times{4, 4.125, 0.125, 8.25, 0}));
  EXPECT_EQ(Of(result, 3), (Times{4, 0, 0.125, 10, 2.375}));
}

TEST(Simulate, JoinOfATaskThatHasEndedPassesAtOnce) {
  const auto result =
      Simulated(Started({{Start(1), Busy(4), Join(1)}, {Busy(1)}}),
                On(2, {.barrier = {}, .event = 8}));
  EXPECT_EQ(Of(result, 0), (Times{4, 0, 0, 0, 0}));
}

TEST(Simulate, TaskThatEndsIsStillOneOfThoseThatShareItsProcessor) {
  const auto result =
      Simulated(Started({{Start(1), Join(1)}, {Busy(1)}}),
                On(1, {.barrier = {}, .event = 8, .turn = 0.25}));
  EXPECT_EQ(Of(result, 0), (Times{0, 1.25, 0.25, 0, 0}));
}

TEST(Simulate, EveryJoinerOfATaskGoesOn) {
  const Program program = Tasks({{Join(2)}, {Join(2)}, {Busy(2)}});
  const auto result = Simulated(program, On(3, {.barrier = {}, .event = 0.5}));
  EXPECT_EQ(End(result, 0), 2.5);
  EXPECT_EQ(End(result, 1), 2.5);
  EXPECT_EQ(End(result, 2), 2);
}

// --- Waits that do not end ---------------------------------------------------

TEST(Simulate, SaysWhoWaitsForWhichBarrier) {
  Program program = Tasks({{Busy(1)}, {Sync(StepKind::kBarrier, 1)}});
  program.barriers = {1, 2};
  EXPECT_EQ(WhyForEver(program), "task 2 would wait for barrier 2 for ever");
}

TEST(Simulate, SaysWhoWaitsForWhichEvent) {
  EXPECT_EQ(WhyForEver(Tasks({{Busy(1)}, {Post(3), Clear(3), Wait(3)}})),
            "task 2 would wait for event 4 for ever");
}

TEST(Simulate, SaysWhoWaitsForWhichLock) {
  EXPECT_EQ(WhyForEver(Tasks({{LockOn(), LockOn()}})),
            "task 1 would wait for lock 1 for ever");
}

TEST(Simulate, SaysWhoWaitsForTheEndOfWhichTask) {
  EXPECT_EQ(WhyForEver(Tasks({{Join(1)}, {Wait(0)}})),
            "task 1 would wait for task 2 for ever");
  EXPECT_EQ(WhyForEver(Started({{Join(1)}, {}})),
            "task 1 would wait for task 2 for ever");
}

TEST(Simulate, SaysThatNobodyStartsATask) {
  EXPECT_EQ(WhyForEver(Started({{Busy(1)}, {Busy(1)}})),
            "a task would wait for its start for ever");
}

}  // namespace
}  // namespace bench::predict
