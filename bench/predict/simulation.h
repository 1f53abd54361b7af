#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "bench/predict/machine.h"
#include "bench/predict/program.h"

// A discrete-event simulation of tasks on processors.

namespace bench::predict {

enum class TaskPlacement {
  kPinned,  // as macrotask::Placement puts them: neighbours together
  kFree,    // on whichever processor is free
};

// Where the tasks of a program run, and what it costs them to wait.
struct SimulationOptions {
  int processors = 1;
  TaskPlacement placement = TaskPlacement::kPinned;
  WaitCost wait = {};
  // By block; the durations of a program without them are exact.
  std::array<Spread, kNumBlocks> spreads = {};
  std::uint64_t seed = 1;  // of what is drawn from the spreads
};

// Where the time of one task went (s). Adds up to that of the run.
struct TaskTimes {
  double compute = 0;
  double imbalance = 0;  // until the last one came, or the post, or the release
  double sync = 0;       // from then on, and what calls and turns cost
  double queue = 0;      // it could go on, but others had its processor
  double absent = 0;     // before its start, after its end

  double total() const { return compute + imbalance + sync + queue + absent; }
};

struct SimulationResult {
  double seconds = 0;  // until the last task has ended
  std::vector<TaskTimes> tasks;
};

// Runs `program`. Each task follows its steps; a task that waits leaves its
// processor to the next one that is ready there, in the order in which they
// became ready; nobody is interrupted. The same arguments give the same doubles.
//
// A wait that ends by another task's call, at a barrier by the last arrival, is
// over
//   with a processor for every live task: after WaitCost::barrier, event, lock,
//     or, if it has lasted longer than sleeps_after, after `wake`, and then the
//     call that ended it costs its caller `waker`;
//     A wait for an event that was posted less than WaitCost::event ago ends
//     when that time is over;
//   with more live tasks than processors: at once for the tasks of the caller's
//     processor, after `shared_wake` for others; and each task that follows
//     another one on its processor first takes `turn`.
//
// Throws std::runtime_error, one sentence, if tasks wait for ever.
SimulationResult Simulate(const Program& program,
                          const SimulationOptions& options);

}  // namespace bench::predict
