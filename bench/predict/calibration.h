#pragma once

#include <chrono>
#include <functional>
#include <vector>

#include "bench/predict/block_calibration.h"
#include "bench/predict/machine.h"
#include "bench/predict/wait_calibration.h"
#include "bench/sync_conditions.h"
#include "macrotask/wait_policy.h"

// This machine as a model, measured.

namespace bench::predict {

struct CalibrationOptions {
  std::vector<int> lanes = {1, 4};
  std::chrono::nanoseconds hold_time = macrotask::kDefaultHoldTime;
  int most_tasks = 64;  // of the figures that are to be predicted
};

class Calibration {
 public:
  // Throws std::invalid_argument, one sentence, if there are not two
  // processors, or the history trace is in use.
  explicit Calibration(const CalibrationOptions& options);

  // A shared machine changes in seconds. What is compared with a calibration is
  // measured in between: Step() makes the next one of num_steps() small
  // measurements, in turn.
  int num_steps() const { return blocks_.num_runs() + waits_.num_rows(); }
  void Step();

  // The split of near and far that all round trips so far and `others` show.
  DistanceSplit Split(const std::vector<double>& others = {}) const;
  // What all rounds so far say; of what was measured while a processor was
  // taken away or the distance changed, nothing.
  MachineModel Fit(const DistanceSplit& split) const;

 private:
  CalibrationOptions options_;
  BlockSampler blocks_;
  WaitSampler waits_;
  int next_ = 0;
};

// Steps enough for a prediction.
MachineModel Calibrate(const CalibrationOptions& options,
                       const std::function<void(int, int)>& show);

}  // namespace bench::predict
