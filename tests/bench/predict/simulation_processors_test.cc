#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <random>
#include <vector>

#include "bench/predict/simulation.h"
#include "tests/bench/predict/programs.h"

namespace bench::predict {
namespace {

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

TEST(Simulate, WaitForAnEventThatIsPostedPassesAtOnceAmongNeighbours) {
  const auto result =
      Simulated(Tasks({{Post(0), Wait(1)}, {Wait(0), Post(1), Busy(1)}}),
                On(1, kCrowded));
  EXPECT_EQ(Of(result, 1), (Times{1, 0, 0.25, 0, 0.25}));
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

}  // namespace
}  // namespace bench::predict
