#include "bench/breakdown_run.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <stdexcept>
#include <string>
#include <utility>

#include "macrotask/trace.h"

namespace bench {
namespace {

using integrators::IntegrationResult;

// The most that a task leaves: five waits in a block of Figure 8; three
// barriers of all tasks, beginning and end of the run.
constexpr std::int64_t kRecordsPerBlock = 10;
constexpr std::int64_t kRecordsPerRun = 8;

class Recording {
 public:
  Recording() {
    using macrotask::TraceClass;
    macrotask::SetTraceClasses(static_cast<std::uint32_t>(TraceClass::kEvents) |
                               static_cast<std::uint32_t>(TraceClass::kUsers) |
                               macrotask::kLeanTrace);
  }
  ~Recording() { macrotask::SetTraceClasses(0); }
  Recording(const Recording&) = delete;
  Recording& operator=(const Recording&) = delete;
};

double SecondsOfSecond(const std::function<IntegrationResult()>& run) {
  run();
  return run().seconds();
}

}  // namespace

void PrepareBreakdown(const BreakdownOptions& options) {
  if (macrotask::TraceClasses() != 0) {
    throw std::invalid_argument(
        "--breakdown and MACROTASK_TRACE: expected one of them, both record");
  }
  const std::int64_t records =
      kRecordsPerBlock * options.most_blocks + kRecordsPerRun;
  constexpr std::int64_t kMost = std::int64_t{1} << 24;  // 400 MB
  const int tasks = options.partition.num_tasks();
  if (records * tasks > kMost) {
    throw std::invalid_argument(
        "--breakdown of " + std::to_string(tasks) + " tasks with " +
        std::to_string(options.most_blocks) +
        " blocks each: expected at most " +
        std::to_string(kMost / kRecordsPerBlock) + " blocks of all tasks");
  }
  // No more than one run needs, so that the rings stay in the cache.
  macrotask::SetTraceSize(static_cast<std::size_t>(records));
}

MeasuredBreakdown MeasureBreakdown(
    const std::function<IntegrationResult()>& run,
    const BreakdownOptions& options) {
  MeasuredBreakdown measured;
  measured.options = options;
  const auto constructs = ConstructsOf(options.figure, options.partition);
  const auto run_traced = [&] {
    TracedRun traced;
    {
      const Recording recording;
      traced.seconds = SecondsOfSecond(run);
    }
    const macrotask::Trace trace = macrotask::TakeTrace();
    traced.tasks = BreakDown(
        RecordsOfLastRun(trace, options.partition.num_tasks()), constructs);
    // The later, the more digits.
    measured.ticks_per_second = trace.ticks_per_second;
    measured.traced.push_back(std::move(traced));
  };
  for (int r = 0; r < options.repetitions; ++r) {
    const bool traced_first = r % 2 == 0;
    if (traced_first) run_traced();
    measured.untraced_seconds.push_back(SecondsOfSecond(run));
    if (!traced_first) run_traced();
  }
  return measured;
}

std::vector<TracedRun> MiddleHalf(std::vector<TracedRun> runs) {
  std::stable_sort(runs.begin(), runs.end(),
                   [](const TracedRun& a, const TracedRun& b) {
                     return a.seconds < b.seconds;
                   });
  const auto dropped = static_cast<std::ptrdiff_t>(runs.size() / 4);
  return {std::make_move_iterator(runs.begin() + dropped),
          std::make_move_iterator(runs.end() - dropped)};
}

}  // namespace bench
