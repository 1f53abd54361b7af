#pragma once

#include <chrono>

#include "bench/lift_case.h"
#include "bench/predict/marked_system.h"
#include "bench/predict/prediction.h"
#include "dynamics/closed_chain_system.h"
#include "integrators/integration.h"

namespace bench::predict {

// Brings the machine into the same state before every measurement: how fast a
// processor of a virtual machine is, and where it is, depends on what both have
// just done. Both compute for half a millisecond.
void MeetBoth();

// Then calls `run` again and again for another one and a half.
template <typename Run>
void WarmUp(const Run& run) {
  using Clock = std::chrono::steady_clock;
  MeetBoth();
  const auto end = Clock::now() + std::chrono::microseconds(1500);
  do {
    run();
  } while (Clock::now() < end);
}

// Seconds that a step of Delay() takes in each of so many tasks, one or two,
// with a processor each; the slowest of them.
double MeasureDelayStep(int num_tasks);

// The run of a case on this machine. Made with as many processors in use as it
// is to run on (macrotask::SetMaxProcessors).
class MeasuredRun {
 public:
  // The case's work is done in this many steps of Delay() for each chain at
  // each point. `lift` must outlive it, and its number of steps is that of the
  // case.
  MeasuredRun(const RunCase& run_case, const LiftCase& lift,
              macrotask::WaitPolicy wait, long delay_steps);

  // Seconds of one run, started from the plan, behind others that warm up.
  double Measure();

 private:
  const LiftCase& lift_;
  dynamics::ClosedChainSystem system_;
  SystemWith<dynamics::ClosedChainSystem> with_work_;
  integrators::Integration integration_;
};

// Uses so many processors for the length of a block.
class ProcessorsFor {
 public:
  explicit ProcessorsFor(int processors);
  ~ProcessorsFor();
  ProcessorsFor(const ProcessorsFor&) = delete;
  ProcessorsFor& operator=(const ProcessorsFor&) = delete;

 private:
  int before_;
};

}  // namespace bench::predict
