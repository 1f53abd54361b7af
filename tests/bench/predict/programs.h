#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <random>
#include <vector>

#include "bench/predict/simulation.h"

// Programs for the simulation, and what its results are.
//
// Durations are multiples of a power of two unless a test says otherwise: sums
// of them are exact, and so are all comparisons.

namespace bench::predict {

// compute, imbalance, sync, queue, absent; see Of()
using Times = std::array<double, 5>;

inline constexpr int kTaskCounts[] = {1, 2, 3, 4, 7, 16};

inline Step Busy(double seconds) { return Compute(Block::kOther, seconds); }
inline Step Barrier() { return Sync(StepKind::kBarrier, 0); }
inline Step Post(int event) { return Sync(StepKind::kPost, event); }
inline Step Wait(int event) { return Sync(StepKind::kWait, event); }
inline Step Clear(int event) { return Sync(StepKind::kClear, event); }
inline Step LockOn() { return Sync(StepKind::kLock, 0); }
inline Step LockOff() { return Sync(StepKind::kUnlock, 0); }
inline Step Start(int task) { return Sync(StepKind::kStart, task); }
inline Step Join(int task) { return Sync(StepKind::kJoin, task); }

// A task for each list of steps, one barrier of `barrier` tasks, and enough of
// the rest.
inline Program Tasks(const std::vector<std::vector<Step>>& lists,
                     int barrier = 0) {
  Program program;
  for (const auto& steps : lists) program.tasks.push_back({steps, {}, {}});
  program.barriers = {barrier > 0 ? barrier : program.num_tasks()};
  program.num_events = 4;
  program.num_locks = 1;
  return program;
}

// The first task starts the others.
inline Program Started(const std::vector<std::vector<Step>>& lists) {
  Program program = Tasks(lists);
  for (int t = 1; t < program.num_tasks(); ++t) {
    program.tasks[static_cast<std::size_t>(t)].started = true;
  }
  return program;
}

inline SimulationOptions On(int processors, const WaitCost& wait = {},
                            TaskPlacement placement = TaskPlacement::kPinned) {
  return {.processors = processors, .placement = placement, .wait = wait};
}

inline SimulationResult Simulated(const Program& program,
                                  const SimulationOptions& options) {
  SimulationResult result = Simulate(program, options);
  for (const TaskTimes& task : result.tasks) {
    EXPECT_EQ(task.total(), result.seconds);
  }
  return result;
}

inline Times Of(const SimulationResult& result, std::size_t task) {
  const TaskTimes& times = result.tasks.at(task);
  return {times.compute, times.imbalance, times.sync, times.queue,
          times.absent};
}

// When a task that begins at 0 ends.
inline double End(const SimulationResult& result, std::size_t task) {
  return result.seconds - result.tasks.at(task).absent;
}

inline void ExpectSame(const SimulationResult& a, const SimulationResult& b) {
  EXPECT_EQ(a.seconds, b.seconds);
  ASSERT_EQ(a.tasks.size(), b.tasks.size());
  for (std::size_t t = 0; t < a.tasks.size(); ++t) {
    EXPECT_EQ(Of(a, t), Of(b, t)) << "task " << t;
  }
}

inline Program Phases(int num_tasks, long phases, double work) {
  Program program;
  program.barriers = {num_tasks};
  program.tasks.assign(static_cast<std::size_t>(num_tasks),
                       {{}, {Busy(work), Barrier()}, {}, phases});
  return program;
}

// Of tasks with a processor each.
inline constexpr WaitCost kSleepy = {
    .barrier = {.two = 0.125, .further = 0},
    .event = 0.125,
    .lock = 0.125,
    .sleeps_after = 2,
    .wake = 0.5,
    .waker = 0.25,
    .turn = 8,          // must not matter to tasks
    .shared_wake = 8};  // with a processor each

// Multiples of 1/64 below 1.
inline double Draw(std::mt19937_64* random) {
  return static_cast<double>((*random)() % 64) / 64;
}

}  // namespace bench::predict
