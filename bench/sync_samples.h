#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bench/sync_conditions.h"
#include "bench/sync_variant.h"

namespace bench {

// One sample of a variant: a loop of calls, the same loop without them in the
// same repetition, and a loop with timestamps.
struct SyncSample {
  double seconds = 0;                 // one call
  double reference = 0;               // one turn of the loop without it
  double cpu = 0;                     // s, one call, all tasks
  std::optional<double> first, last;  // s, medians of the latencies
  std::optional<double> fairness;     // fewest acquisitions of a task to most
  SampleConditions conditions;
};

struct SyncSeries {
  Variant variant;
  long calls = 0;  // in a sample
  std::vector<SyncSample> samples;
};

// The number of calls, a power of two, from which on a sample lasts `target`
// seconds or `most` calls: doubled from 1, as `seconds(calls)` was.
long CallsForTarget(const std::function<double(long)>& seconds, double target,
                    long most);

// The fewest to the most calls of a task; 1 if nobody made any.
double FairnessOf(const std::vector<long>& calls);

struct SamplingOptions {
  int repetitions = 20;
  double target = 1e-3;  // s, the least duration of a sample
  double limit = 50e-3;  // s, at which a loop stops
};

// Samples all variants in turn, again and again; the first time, in which the
// number of calls is found, is dropped. Those that are missing stay without
// samples. `show(done, all)` is called now and then.
std::vector<SyncSeries> SampleAll(const std::vector<Variant>& variants,
                                  const SamplingOptions& options,
                                  const std::function<void(int, int)>& show);

}  // namespace bench
