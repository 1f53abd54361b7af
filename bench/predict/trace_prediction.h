#pragma once

#include <string>
#include <vector>

#include "bench/predict/prediction.h"

// Predictions of a program of anybody's, from its history trace.

namespace bench::predict {

struct TracePrediction {
  int processors = 1;
  Prediction prediction;
};

std::vector<TracePrediction> PredictTrace(const Program& program,
                                          const std::vector<int>& processors,
                                          macrotask::WaitKind wait,
                                          TaskPlacement placement,
                                          Predictor* predictor);

// A table that pastes as Markdown. `measured`: how long the trace is (s).
std::string TracePredictionText(const Program& program, double measured,
                                const std::vector<TracePrediction>& rows);

}  // namespace bench::predict
