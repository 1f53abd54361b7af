#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/machine.h"
#include "bench/sync_break_even.h"
#include "bench/sync_clock.h"
#include "bench/sync_rows.h"

namespace bench {

// All that one run of `macrotask sync` has found.
struct SyncResult {
  Machine machine;
  SyncAxes axes;
  int repetitions = 0;
  std::optional<ClockAgreement> clocks;  // none with one processor
  DistanceSplit split{};
  std::vector<double> round_trips;  // s, all that were measured
  std::vector<SyncRow> rows;
  std::optional<BreakEven> break_even;
};

// Tables that paste as Markdown.
std::string SyncText(const SyncResult& result);

// The same, one line per row. Nanoseconds.
std::string SyncCsv(const SyncResult& result);

// The layout of Google Benchmark: "context" and "benchmarks".
std::string SyncJson(const SyncResult& result);

// "BARSYNC/hold/tasks:2/work_us:0/skew:zero", with "/near" or "/far" if there
// are both.
std::string RowName(const SyncRow& row);

// "1.2 us": a duration with the unit that suits it and three figures or so.
std::string DurationText(double seconds);

}  // namespace bench
