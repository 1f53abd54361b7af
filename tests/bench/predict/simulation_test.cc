#include "bench/predict/simulation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>

// Durations are multiples of a power of two unless a test says otherwise: sums
// of them are exact, and so are all comparisons.

namespace bench::predict {
namespace {

using Times = std::array<double, 5>;

constexpr int kTaskCounts[] = {1, 2, 3, 4, 7, 16};

Step Busy(double seconds) { return Compute(Block::kOther, seconds); }
Step Barrier() { return Sync(StepKind::kBarrier, 0); }
Step Post(int event) { return Sync(StepKind::kPost, event); }
Step Wait(int event) { return Sync(StepKind::kWait, event); }
Step Clear(int event) { return Sync(StepKind::kClear, event); }
Step LockOn() { return Sync(StepKind::kLock, 0); }
Step LockOff() { return Sync(StepKind::kUnlock, 0); }
Step Start(int task) { return Sync(StepKind::kStart, task); }
Step Join(int task) { return Sync(StepKind::kJoin, task); }

// A task for each list of steps, one barrier of `barrier` tasks, and enough of
// the rest.
Program Tasks(const std::vector<std::vector<Step>>& lists, int barrier = 0) {
  Program program;
  for (const auto& steps : lists) program.tasks.push_back({steps, {}, {}});
  program.barriers = {barrier > 0 ? barrier : program.num_tasks()};
  program.num_events = 4;
  program.num_locks = 1;
  return program;
}

// The first task starts the others.
Program Started(const std::vector<std::vector<Step>>& lists) {
  Program program = Tasks(lists);
  for (int t = 1; t < program.num_tasks(); ++t) {
    program.tasks[static_cast<std::size_t>(t)].started = true;
  }
  return program;
}

SimulationOptions On(int processors, const WaitCost& wait = {},
                     TaskPlacement placement = TaskPlacement::kPinned) {
  return {.processors = processors, .placement = placement, .wait = wait};
}

SimulationResult Simulated(const Program& program,
                           const SimulationOptions& options) {
  SimulationResult result = Simulate(program, options);
  for (const TaskTimes& task : result.tasks) {
    EXPECT_EQ(task.total(), result.seconds);
  }
  return result;
}

// compute, imbalance, sync, queue, absent
Times Of(const SimulationResult& result, std::size_t task) {
  const TaskTimes& times = result.tasks.at(task);
  return {times.compute, times.imbalance, times.sync, times.queue,
          times.absent};
}

// When a task that begins at 0 ends.
double End(const SimulationResult& result, std::size_t task) {
  return result.seconds - result.tasks.at(task).absent;
}

void ExpectSame(const SimulationResult& a, const SimulationResult& b) {
  EXPECT_EQ(a.seconds, b.seconds);
  ASSERT_EQ(a.tasks.size(), b.tasks.size());
  for (std::size_t t = 0; t < a.tasks.size(); ++t) {
    EXPECT_EQ(Of(a, t), Of(b, t)) << "task " << t;
  }
}

std::string WhyForEver(const Program& program) {
  try {
    Simulate(program, On(4));
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "it ends";
}

// --- Steps ------------------------------------------------------------------

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

// --- Start and join ---------------------------------------------------------

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

// --- Barriers ---------------------------------------------------------------

Program Phases(int num_tasks, long phases, double work) {
  Program program;
  program.barriers = {num_tasks};
  program.tasks.assign(static_cast<std::size_t>(num_tasks),
                       {{}, {Busy(work), Barrier()}, {}, phases});
  return program;
}

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

// --- Events -----------------------------------------------------------------

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

TEST(Simulate, WaitForAnEventThatIsPostedPassesAtOnce) {
  const auto result =
      Simulated(Tasks({{Post(0)}, {Busy(1), Wait(0), Busy(1), Wait(0)}}),
                On(2, {.barrier = {}, .event = 8}));
  EXPECT_EQ(Of(result, 1), (Times{2, 0, 0, 0, 0}));
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

// --- Locks ------------------------------------------------------------------

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

// --- Sleepers ---------------------------------------------------------------

constexpr WaitCost kSleepy = {.barrier = {.two = 0.125, .further = 0},
                              .event = 0.125,
                              .lock = 0.125,
                              .sleeps_after = 2,
                              .wake = 0.5,
                              .waker = 0.25,
                              .turn = 8,          // must not matter to tasks
                              .shared_wake = 8};  // with a processor each

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

// --- More tasks than processors ---------------------------------------------

TEST(Simulate, TasksOnOneProcessorRunOneAfterTheOther) {
  const auto result = Simulated(Tasks({{Busy(1)}, {Busy(2)}}),
                                On(1, {.barrier = {}, .turn = 0.25}));
  EXPECT_EQ(Of(result, 0), (Times{1, 0, 0, 0, 2.25}));
  EXPECT_EQ(Of(result, 1), (Times{2, 0, 0.25, 1, 0}));
}

// The wait costs of tasks with a processor each: they must not matter.
constexpr WaitCost kCrowded = {.barrier = {.two = 8, .further = 8},
                               .event = 8,
                               .lock = 8,
                               .sleeps_after = 0,
                               .wake = 8,
                               .waker = 8,
                               .turn = 0.25,
                               .shared_wake = 0.5};

TEST(Simulate, LastAtABarrierKeepsTheProcessorThatItSharesWithTheFirst) {
  const std::vector<Step> steps = {Busy(1), Barrier(), Busy(1)};
  const auto result = Simulated(Tasks({steps, steps}), On(1, kCrowded));
  EXPECT_EQ(Of(result, 0), (Times{2, 1.25, 0.25, 1, 0}));
  EXPECT_EQ(Of(result, 1), (Times{2, 0, 0.25, 1, 1.25}));
}

// Tasks 0 and 1, and 2 and 3, share a processor; 3 is the last to arrive.
TEST(Simulate, BarrierWakesTheTasksOfAnotherProcessorLater) {
  const std::vector<Step> steps = {Busy(1), Barrier(), Busy(1)};
  const auto result =
      Simulated(Tasks({steps, steps, steps, steps}), On(2, kCrowded));
  EXPECT_EQ(Of(result, 0), (Times{2, 1.25, 0.75, 0, 1.25}));
  EXPECT_EQ(Of(result, 1), (Times{2, 0, 1, 2.25, 0}));
  EXPECT_EQ(Of(result, 2), (Times{2, 1.25, 0.25, 1, 0.75}));
  EXPECT_EQ(Of(result, 3), (Times{2, 0, 0.25, 1, 2}));
}

TEST(Simulate, TaskThatIsLetGoQueuesBehindWhoeverHasItsProcessor) {
  const auto result = Simulated(
      Tasks({{Wait(0)}, {Busy(4)}, {Busy(1), Post(0)}}), On(2, kCrowded));
  EXPECT_EQ(Of(result, 0), (Times{0, 1, 0.75, 2.75, 0}));
  EXPECT_EQ(Of(result, 1), (Times{4, 0, 0.25, 0, 0.25}));
  EXPECT_EQ(Of(result, 2), (Times{1, 0, 0, 0, 3.5}));
}

TEST(Simulate, HolderOfALockKeepsItsProcessorWhenItReleasesIt) {
  const auto result =
      Simulated(Tasks({{LockOn(), Post(0), Wait(1), LockOff(), Busy(1)},
                       {Wait(0), Post(1), LockOn(), Busy(1)}}),
                On(1, kCrowded));
  EXPECT_EQ(Of(result, 0), (Times{1, 0.25, 0.25, 0, 1.25}));
  EXPECT_EQ(Of(result, 1), (Times{1, 0.25, 0.5, 1, 0}));
}

TEST(Simulate, TasksThatHaveEndedCrowdNobody) {
  const std::vector<Step> steps = {Busy(2), Barrier()};
  const auto result =
      Simulated(Tasks({{Barrier()}, {}, steps}, 2),
                On(2, {.barrier = {.two = 0.25}, .shared_wake = 8}));
  EXPECT_EQ(result.seconds, 2.25);
}

// The k tasks of a processor run one after the other in every phase: a phase
// lasts as long as the fullest processor computes.
double CalcPinnedPhases(const std::vector<std::vector<double>>& phases, int n,
                        int processors) {
  const int used = std::min(n, processors);
  double seconds = 0;
  for (const auto& work : phases) {
    std::vector<double> load(static_cast<std::size_t>(used));
    for (int t = 0; t < n; ++t) {
      load[static_cast<std::size_t>(t * used / n)] +=
          work[static_cast<std::size_t>(t)];
    }
    seconds += *std::max_element(load.begin(), load.end());
  }
  return seconds;
}

// Multiples of 1/64 below 1.
double Draw(std::mt19937_64* random) {
  return static_cast<double>((*random)() % 64) / 64;
}

std::vector<std::vector<double>> RandomPhases(std::uint64_t seed, int n) {
  std::mt19937_64 random(seed);
  std::vector<std::vector<double>> phases(
      6, std::vector<double>(static_cast<std::size_t>(n)));
  for (auto& phase : phases) {
    for (double& work : phase) work = Draw(&random);
  }
  return phases;
}

Program ProgramOf(const std::vector<std::vector<double>>& phases, int n) {
  Program program = Phases(n, 0, 0);
  for (const auto& phase : phases) {
    for (std::size_t t = 0; t < phase.size(); ++t) {
      program.tasks[t].head.push_back(Busy(phase[t]));
      program.tasks[t].head.push_back(Barrier());
    }
  }
  return program;
}

TEST(Simulate, PhaseLastsAsLongAsTheFullestProcessorComputes) {
  for (const int n : kTaskCounts) {
    const auto phases = RandomPhases(17, n);
    for (int processors = 1; processors <= n + 2; ++processors) {
      EXPECT_EQ(Simulated(ProgramOf(phases, n), On(processors)).seconds,
                CalcPinnedPhases(phases, n, processors))
          << n << " tasks on " << processors;
    }
  }
}

// Only if the tasks then have one each: on 2 of 3 processors the two slow ones
// of five tasks may meet that 2 processors keep apart.
TEST(Simulate, ProcessorForEachTaskIsNeverSlowerThanFewer) {
  for (const int n : kTaskCounts) {
    for (std::uint64_t seed = 1; seed <= 8; ++seed) {
      const Program program = ProgramOf(RandomPhases(seed, n), n);
      for (const auto placement :
           {TaskPlacement::kPinned, TaskPlacement::kFree}) {
        const double full = Simulated(program, On(n, {}, placement)).seconds;
        for (int fewer = 1; fewer < n; ++fewer) {
          EXPECT_LE(full, Simulated(program, On(fewer, {}, placement)).seconds);
        }
      }
    }
  }
}

TEST(Simulate, ProcessorsWithoutATaskChangeNothing) {
  for (const int n : kTaskCounts) {
    const Program program = ProgramOf(RandomPhases(3, n), n);
    for (const auto placement :
         {TaskPlacement::kPinned, TaskPlacement::kFree}) {
      const auto exact = Simulated(program, On(n, kSleepy, placement));
      ExpectSame(Simulated(program, On(n + 1, kSleepy, placement)), exact);
      ExpectSame(Simulated(program, On(8 * n, kSleepy, placement)), exact);
    }
  }
}

TEST(TaskPlacement, FreeTaskUsesAnIdleProcessorWherePinnedOneQueues) {
  const Program program = Tasks({{Busy(4)}, {Busy(4)}, {Busy(1)}});
  const auto pinned = Simulated(program, On(2));
  EXPECT_EQ(Of(pinned, 1), (Times{4, 0, 0, 4, 0}));
  const auto free = Simulated(program, On(2, {}, TaskPlacement::kFree));
  EXPECT_EQ(free.seconds, 5);
  EXPECT_EQ(Of(free, 1), (Times{4, 0, 0, 0, 1}));
  EXPECT_EQ(Of(free, 2), (Times{1, 0, 0, 4, 0}));
}

TEST(TaskPlacement, FreeTasksHaveNoNeighboursToWakeAtOnce) {
  const std::vector<Step> steps = {Busy(1), Barrier(), Busy(1)};
  const auto result =
      Simulated(Tasks({steps, steps}), On(1, kCrowded, TaskPlacement::kFree));
  // Ready half a second later, and still before the processor is free.
  EXPECT_EQ(Of(result, 0), (Times{2, 1.25, 0.75, 0.5, 0}));
}

// --- Waits that do not end --------------------------------------------------

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

// --- Spreads ----------------------------------------------------------------

SimulationOptions Spreading(const Spread& spread, std::uint64_t seed,
                            int processors = 4) {
  SimulationOptions options = On(processors, kSleepy);
  options.spreads.fill(spread);
  options.seed = seed;
  return options;
}

TEST(Simulate, SameSeedGivesTheSameDoubles) {
  const Program program = Phases(7, 20, 0.1);
  const Spread spread = {0.9, 1, 1.7};
  ExpectSame(Simulate(program, Spreading(spread, 5)),
             Simulate(program, Spreading(spread, 5)));
}

TEST(Simulate, AnotherSeedGivesOthers) {
  const Program program = Phases(7, 20, 0.1);
  const Spread spread = {0.9, 1, 1.7};
  const auto one = Simulate(program, Spreading(spread, 5));
  const auto other = Simulate(program, Spreading(spread, 6));
  EXPECT_NE(one.seconds, other.seconds);
  for (std::size_t t = 0; t < one.tasks.size(); ++t) {
    EXPECT_NE(one.tasks[t].compute, other.tasks[t].compute);
    EXPECT_NE(one.tasks[t].compute, one.tasks[(t + 1) % 7].compute);
  }
}

TEST(Simulate, SeedDoesNotMatterWithoutSpreads) {
  const Program program = Phases(7, 20, 0.1);
  ExpectSame(Simulate(program, Spreading({}, 5)),
             Simulate(program, Spreading({}, 6)));
}

TEST(Simulate, WhatATaskDrawsDoesNotDependOnTheProcessors) {
  const Program program = Phases(4, 20, 0.1);
  const auto four = Simulate(program, Spreading({0.9, 1, 1.7}, 5, 4));
  const auto one = Simulate(program, Spreading({0.9, 1, 1.7}, 5, 1));
  for (std::size_t t = 0; t < 4; ++t) {
    EXPECT_EQ(four.tasks[t].compute, one.tasks[t].compute);
  }
}

TEST(Simulate, SpreadOfOneRatioScalesExactly) {
  for (const Spread& spread : {Spread{2}, Spread{2, 2}, Spread{2, 2, 2}}) {
    EXPECT_EQ(Simulated(Phases(3, 5, 1), Spreading(spread, 9)).tasks[0].compute,
              10);
  }
}

TEST(Simulate, SpreadIsThatOfTheBlock) {
  SimulationOptions options = On(1);
  options.spreads[static_cast<std::size_t>(Block::kRma)] = {4};
  const auto result = Simulated(
      Tasks({{Compute(Block::kRma, 1), Compute(Block::kOcd, 1)}}), options);
  EXPECT_EQ(result.seconds, 5);
}

// Half of the ratios are spread evenly over 0.5 to 1, half over 1 to 3: 1.375
// on average, with a standard deviation of 0.75 (variances: 0.02 and 0.33 of the
// halves, averaged, and 0.39 between them). That of the mean of 4096: 0.012.
TEST(Simulate, RatiosFollowTheQuantilesOfTheirSpread) {
  Program program = Tasks({{}});
  program.tasks[0] = {{}, {Busy(1)}, {}, 4096};
  const double mean =
      Simulate(program, Spreading({0.5, 1, 3}, 1)).seconds / 4096;
  EXPECT_NEAR(mean, 1.375, 4 * 0.012);
}

// --- Where time goes --------------------------------------------------------

// A phase: every task computes, maybe with a lock, posts its own event, maybe
// waits for one that somebody posts in the same phase, and meets all others.
// Nobody waits before its post, so that all of it ends. `unit` s scales it.
class RandomProgram {
 public:
  explicit RandomProgram(std::uint64_t seed, double unit = 1)
      : random_(seed), unit_(unit), n_(kTaskCounts[random_() % 6]) {
    program_ = Phases(n_, 0, 0);
    program_.num_locks = 2;
    const int phases = 1 + static_cast<int>(random_() % 4);
    program_.num_events = phases * n_;
    for (int phase = 0; phase < phases; ++phase) {
      for (int t = 0; t < n_; ++t) AddPhase(t, phase * n_);
    }
  }

  const Program& program() const { return program_; }

  SimulationOptions RandomOptions() {
    const auto draw = [this] { return unit_ * Draw(&random_); };
    WaitCost wait = {.barrier = {.two = draw(), .further = draw()}};
    for (double WaitCost::*cost :
         {&WaitCost::event, &WaitCost::post, &WaitCost::lock,
          &WaitCost::sleeps_after, &WaitCost::wake, &WaitCost::waker,
          &WaitCost::turn, &WaitCost::shared_wake}) {
      wait.*cost = draw();
    }
    const auto most = static_cast<std::uint64_t>(n_ + 2);
    return On(1 + static_cast<int>(random_() % most), wait,
              random_() % 2 ? TaskPlacement::kFree : TaskPlacement::kPinned);
  }

 private:
  void AddPhase(int t, int first_event) {
    auto& steps = program_.tasks[static_cast<std::size_t>(t)].head;
    const auto add_work = [&] {
      steps.push_back(Compute(static_cast<Block>(random_() % kNumBlocks),
                              unit_ * Draw(&random_)));
    };
    add_work();
    if (random_() % 2) {
      const int lock = static_cast<int>(random_() % 2);
      steps.push_back(Sync(StepKind::kLock, lock));
      add_work();
      steps.push_back(Sync(StepKind::kUnlock, lock));
    }
    steps.push_back(Post(first_event + t));
    const auto other = static_cast<int>(random_() % 32);
    if (other < n_) steps.push_back(Wait(first_event + other));
    add_work();
    steps.push_back(Barrier());
  }

  std::mt19937_64 random_;
  double unit_;
  int n_;
  Program program_;
};

double WorkOf(const TaskProgram& task) {
  Program alone;
  alone.tasks = {task};
  return Work(alone);
}

TEST(TaskTimes, AddUpToTheRunExactlyWhereDurationsDo) {
  for (std::uint64_t seed = 1; seed <= 500; ++seed) {
    RandomProgram random(seed);
    SCOPED_TRACE(seed);
    Simulated(random.program(), random.RandomOptions());
  }
}

// A wait makes the most sums of all steps, eight: the clock and `sync` for its
// latency and for a turn, a difference and a sum each for `imbalance` and
// `queue`. Six more are in `absent` and total(). Each rounds by at most half an
// epsilon of the whole.
TEST(TaskTimes, AddUpToTheRunWithinTheRoundingOfTheirSteps) {
  for (std::uint64_t seed = 1; seed <= 500; ++seed) {
    RandomProgram random(seed, 1e-3 / 3);
    const auto result = Simulate(random.program(), random.RandomOptions());
    for (std::size_t t = 0; t < result.tasks.size(); ++t) {
      const auto steps =
          static_cast<double>(random.program().tasks[t].head.size());
      EXPECT_NEAR(result.tasks[t].total(), result.seconds,
                  4 * (steps + 1) * std::numeric_limits<double>::epsilon() *
                      result.seconds)
          << "seed " << seed;
    }
  }
}

TEST(TaskTimes, ComputeIsTheWorkOfTheProgram) {
  for (std::uint64_t seed = 1; seed <= 500; ++seed) {
    RandomProgram random(seed);
    const auto result = Simulated(random.program(), random.RandomOptions());
    for (std::size_t t = 0; t < result.tasks.size(); ++t) {
      EXPECT_EQ(result.tasks[t].compute, WorkOf(random.program().tasks[t]))
          << "seed " << seed;
    }
  }
}

TEST(TaskTimes, NoneIsNegative) {
  for (std::uint64_t seed = 1; seed <= 500; ++seed) {
    RandomProgram random(seed);
    const auto result = Simulated(random.program(), random.RandomOptions());
    for (std::size_t t = 0; t < result.tasks.size(); ++t) {
      for (const double part : Of(result, t)) EXPECT_GE(part, 0) << seed;
    }
  }
}

TEST(Simulate, NoRunIsShorterThanItsWorkOnAllProcessorsOrItsLongestTask) {
  for (std::uint64_t seed = 1; seed <= 500; ++seed) {
    RandomProgram random(seed);
    const SimulationOptions options = random.RandomOptions();
    const auto result = Simulated(random.program(), options);
    EXPECT_GE(result.seconds * options.processors, Work(random.program()));
    for (const TaskProgram& task : random.program().tasks) {
      EXPECT_GE(result.seconds, WorkOf(task)) << "seed " << seed;
    }
  }
}

TEST(Simulate, OneProcessorWithoutCostsIsNeverIdle) {
  for (std::uint64_t seed = 1; seed <= 500; ++seed) {
    const RandomProgram random(seed);
    EXPECT_EQ(Simulated(random.program(), On(1)).seconds,
              Work(random.program()));
  }
}

}  // namespace
}  // namespace bench::predict
