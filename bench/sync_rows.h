#pragma once

#include <optional>
#include <vector>

#include "bench/statistics.h"
#include "bench/sync_samples.h"

namespace bench {

// What the samples of a variant say at one distance of the processors. Seconds.
struct SyncRow {
  Variant variant;
  Distance distance = Distance::kOnly;
  long calls = 0;    // in a sample
  Dropped dropped;   // of the samples that began at this distance
  double total = 0;  // one call and its work, median
  double cpu = 0;    // likewise, of all tasks
  // None if there is no undisturbed sample; latencies also where the construct
  // has none.
  std::optional<Summary> overhead, first, last, fairness;
};

// What the construct adds to a turn of the loop, by repetition; of a part of
// it where the call has several.
std::vector<double> Overheads(const std::vector<SyncSample>& samples,
                              int parts);

// The split that all round trips of the series show.
DistanceSplit SplitOf(const std::vector<SyncSeries>& series);

// A row for each distance at which there are samples, of each series in turn;
// one without figures if there are none at all.
std::vector<SyncRow> MakeRows(const std::vector<SyncSeries>& series,
                              const DistanceSplit& split);

}  // namespace bench
