#pragma once

#include <chrono>

#include "bench/lift_case.h"
#include "bench/predict/marked_system.h"
#include "bench/predict/prediction.h"
#include "dynamics/closed_chain_system.h"
#include "integrators/integration.h"

namespace bench::predict {

// Calls `run` again and again for 2 ms: the caches are warm, and a virtual
// machine has its processors where they stay while they compute. After a sleep
// they may share a core for a while.
template <typename Run>
void WarmUp(const Run& run) {
  const auto end =
      std::chrono::steady_clock::now() + std::chrono::milliseconds(2);
  do {
    run();
  } while (std::chrono::steady_clock::now() < end);
}

// The run of a case on this machine. Made with as many processors in use as it
// is to run on (macrotask::SetMaxProcessors).
class MeasuredRun {
 public:
  // `delay_rate`: see MeasureDelayRate(). `lift` must outlive it, and its
  // number of steps is that of the case.
  MeasuredRun(const RunCase& run_case, const LiftCase& lift,
              macrotask::WaitPolicy wait, double delay_rate);

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
