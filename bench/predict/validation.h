#pragma once

#include <functional>
#include <string>
#include <vector>

#include "bench/predict/calibration.h"
#include "bench/predict/prediction.h"

// Predicted against measured, on the machine that there is.

namespace bench::predict {

// Everything that one and two processors can run: the serial program and all
// figures with two tasks, every width of lanes and way to wait, synthetic work
// of 0 to 100 us a block, and more tasks than processors. None of it is in the
// calibration, which runs other methods in other partitions and the
// laboratory's loops.
std::vector<RunCase> ValidationCases();

struct ValidationRow {
  RunCase run_case;
  std::string condition;  // of the machine, while it was measured
  double measured = 0;    // s, median
  int n = 0;              // measurements
  double predicted = 0;   // s, median

  // Relative to what was measured.
  double error() const { return predicted / measured - 1; }
};

struct Validation {
  MachineModel machine;
  std::vector<ValidationRow> rows;
  int disturbed = 0;  // measurements that were dropped
};

// Calibrates and measures in turn, so that both see the same machine, then
// predicts. Throws as Calibration does.
Validation Validate(const CalibrationOptions& options, int rounds,
                    const std::function<void(int, int)>& show);

// Errors by group, the worst rows, and whether the goal is met.
std::string ValidationText(const Validation& validation);
std::string ValidationCsv(const Validation& validation);

// "B4PC5 figure8 2x1, 4 lanes, hold, 30 us a block, 2 processors"
std::string RunText(const RunCase& run_case);

// Busy work of all tasks in one block (s), as opposed to RunCase::work.
double WorkABlock(const RunCase& run_case);

}  // namespace bench::predict
