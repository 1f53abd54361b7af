#include <fmt/format.h>

#include <array>
#include <cstddef>
#include <utility>

#include "bench/breakdown_run.h"
#include "bench/statistics.h"
#include "bench/text_table.h"

namespace bench {
namespace {

// One row, all in us or all in percent.
struct Row {
  std::string name;
  double wall = 0, compute = 0, sum = 0;
  std::array<double, kNumConstructs> imbalance{}, sync{};

  // Adds `scale` of a task's part in a run.
  void Add(double wall_seconds, const TaskBreakdown& task,
           double seconds_per_tick, double scale) {
    const auto seconds = [&](std::uint64_t ticks) {
      return static_cast<double>(ticks) * seconds_per_tick;
    };
    wall += wall_seconds * scale;
    compute += seconds(task.compute) * scale;
    sum += seconds(task.total()) * scale;
    for (std::size_t c = 0; c < kNumConstructs; ++c) {
      imbalance[c] += seconds(task.waiting[c].imbalance) * scale;
      sync[c] += seconds(task.waiting[c].sync) * scale;
    }
  }
};

// "3 (2, 1)": Figure 8 calls the tasks (block point, chain).
std::string TaskName(int task, integrators::Partition partition) {
  return fmt::format("{} ({}, {})", task + 1, task / partition.chain_tasks + 1,
                     task % partition.chain_tasks + 1);
}

std::vector<Row> RowsOf(const MeasuredBreakdown& measured,
                        const std::vector<TracedRun>& runs) {
  const integrators::Partition partition = measured.options.partition;
  double all_seconds = 0;
  for (const TracedRun& run : runs) all_seconds += run.seconds;
  const double us = 1e6 / static_cast<double>(runs.size());
  const double percent = 100 / (all_seconds * partition.num_tasks());
  std::vector<Row> rows(static_cast<std::size_t>(partition.num_tasks()) + 1);
  rows.back().name = "all (%)";
  for (int task = 0; task < partition.num_tasks(); ++task) {
    Row& row = rows[static_cast<std::size_t>(task)];
    row.name = TaskName(task, partition);
    for (const TracedRun& run : runs) {
      const TaskBreakdown& part = run.tasks[static_cast<std::size_t>(task)];
      const double seconds_per_tick = 1 / measured.ticks_per_second;
      row.Add(run.seconds, part, seconds_per_tick, us);
      rows.back().Add(run.seconds, part, seconds_per_tick, percent);
    }
  }
  return rows;
}

std::string Table(const MeasuredBreakdown& measured,
                  const std::vector<TracedRun>& runs) {
  const auto constructs =
      ConstructsOf(measured.options.figure, measured.options.partition);
  std::vector<std::string> header = {"task", "wall", "compute"};
  for (const Construct construct : constructs) {
    header.push_back(fmt::format("{} imbalance", Name(construct)));
    header.push_back("sync");
  }
  for (const char* column : {"sum", "residual"}) header.push_back(column);
  TextTable table(header);
  for (const Row& row : RowsOf(measured, runs)) {
    std::vector<double> values = {row.wall, row.compute};
    for (const Construct construct : constructs) {
      values.push_back(row.imbalance[static_cast<std::size_t>(construct)]);
      values.push_back(row.sync[static_cast<std::size_t>(construct)]);
    }
    for (const double value : {row.sum, row.wall - row.sum}) {
      values.push_back(value);
    }
    std::vector<std::string> cells = {row.name};
    for (const double value : values) {
      cells.push_back(fmt::format("{:.2f}", value));
    }
    table.AddRow(std::move(cells));
  }
  return table.Markdown();
}

std::string Disturbance(const MeasuredBreakdown& measured) {
  std::vector<double> traced;
  for (const TracedRun& run : measured.traced) traced.push_back(run.seconds);
  const auto ratios = Ratios(traced, measured.untraced_seconds);
  const Interval interval = MedianInterval(ratios);
  const auto percent = [](double ratio) { return (ratio - 1) * 100; };
  return fmt::format(
      "disturbance: {:.1f} % [{:.1f}, {:.1f}], median and 95 % interval of {} "
      "runs with their\ntrace over runs without one next to them; {:.2f} us "
      "without, {:.2f} us with it (medians).\n",
      percent(Median(ratios)), percent(interval.low), percent(interval.high),
      ratios.size(), Median(measured.untraced_seconds) * 1e6,
      Median(traced) * 1e6);
}

}  // namespace

std::string BreakdownText(const MeasuredBreakdown& measured) {
  const auto runs = MiddleHalf(measured.traced);
  return fmt::format(
             "Where the time went (us): means over {} runs, the middle half by "
             "wall time of {}.\n\n",
             runs.size(), measured.traced.size()) +
         Table(measured, runs) +
         "\n"
         "imbalance: from a task's arrival to the last one's, or to EVPOST; "
         "sync: from then\nuntil it goes on. BARSYNC(all): during the start, "
         "which task 1 computes, and at the\nend. Tasks that share a processor "
         "wait while others have it; one whose processor\nthe system takes "
         "away seems to go on with what it did. residual: wall less sum, the\n"
         "readings of the clock at both ends, and what task 1 took longer to "
         "leave the last\nbarrier. The clocks of the processors must agree: "
         "else imbalance and sync exchange\ntime.\n" +
         Disturbance(measured);
}

}  // namespace bench
