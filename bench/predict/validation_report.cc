#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>

#include "bench/predict/validation.h"
#include "bench/statistics.h"
#include "bench/text_table.h"

namespace bench::predict {
namespace {

std::string Percent(double ratio) { return fmt::format("{:.1f}", ratio * 100); }

double Size(const ValidationRow& row) { return std::abs(row.error()); }

std::string GroupOf(const ValidationRow& row) {
  const RunCase& run = row.run_case;
  const int tasks = run.figure.partition.num_tasks();
  if (tasks == 1) return "serial";
  return fmt::format("{}, {}", macrotask::Name(run.wait),
                     tasks > run.processors ? "crowded" : "a processor each");
}

using Rows = std::vector<const ValidationRow*>;

std::vector<std::string> GroupCells(const std::string& name, const Rows& rows) {
  std::vector<double> sizes, errors;
  for (const ValidationRow* row : rows) {
    sizes.push_back(Size(*row));
    errors.push_back(row->error());
  }
  return {name,
          fmt::format("{}", rows.size()),
          Percent(Median(errors)),
          Percent(Median(sizes)),
          Percent(Percentile(sizes, 0.9)),
          Percent(Percentile(sizes, 1))};
}

std::string GroupTable(const std::vector<ValidationRow>& rows) {
  std::map<std::string, Rows> groups;
  Rows all;
  for (const ValidationRow& row : rows) {
    groups[GroupOf(row)].push_back(&row);
    all.push_back(&row);
  }
  TextTable table(
      {"tasks wait", "runs", "error (%)", "median size", "90 %", "worst"});
  for (const auto& [name, group] : groups) {
    table.AddRow(GroupCells(name, group));
  }
  table.AddRow(GroupCells("all", all));
  return table.Markdown();
}

std::string WorstTable(const std::vector<ValidationRow>& rows) {
  constexpr std::size_t kShown = 10;
  Rows worst;
  for (const ValidationRow& row : rows) worst.push_back(&row);
  std::stable_sort(worst.begin(), worst.end(),
                   [](const ValidationRow* a, const ValidationRow* b) {
                     return Size(*a) > Size(*b);
                   });
  worst.resize(std::min(worst.size(), kShown));
  TextTable table(
      {"run", "condition", "measured (us)", "predicted (us)", "error (%)"});
  for (const ValidationRow* row : worst) {
    table.AddRow({RunText(row->run_case), row->condition,
                  fmt::format("{:.1f}", row->measured * 1e6),
                  fmt::format("{:.1f}", row->predicted * 1e6),
                  Percent(row->error())});
  }
  return table.Markdown();
}

}  // namespace

double WorkABlock(const RunCase& run_case) {
  return run_case.work * 2 * run_case.figure.num_chains *
         run_case.figure.method.block_size;
}

std::string RunText(const RunCase& run) {
  return fmt::format(
      "{} {} {}x{}, {} lane{}, {}, {:.0f} us a block, {} processor{}",
      run.figure.method.name(), integrators::Name(run.figure.figure),
      run.figure.partition.chain_tasks, run.figure.partition.integration_tasks,
      run.num_lanes, run.num_lanes == 1 ? "" : "s", macrotask::Name(run.wait),
      WorkABlock(run) * 1e6, run.processors, run.processors == 1 ? "" : "s");
}

std::string ValidationText(const Validation& validation) {
  std::vector<double> sizes;
  for (const ValidationRow& row : validation.rows) sizes.push_back(Size(row));
  const double median = Median(sizes), worst = Percentile(sizes, 1);
  return fmt::format(
      "Predicted against measured: {} runs on 1 and 2 processors, each "
      "measured in turn\nwith the calibration, none of them part of it; {} "
      "measurements dropped as disturbed.\n\n{}\nThe worst:\n\n{}\n"
      "Goal: median under 5 %, worst under 15 %. Median {:.1f} %: {}. Worst "
      "{:.1f} %: {}.\n",
      validation.rows.size(), validation.disturbed, GroupTable(validation.rows),
      WorstTable(validation.rows), median * 100,
      median < 0.05 ? "met" : "missed", worst * 100,
      worst < 0.15 ? "met" : "missed");
}

std::string ValidationCsv(const Validation& validation) {
  TextTable table({"method", "figure", "chain_tasks", "integration_tasks",
                   "lanes", "wait", "work_a_block_us", "processors",
                   "condition", "n", "measured_s", "predicted_s", "error"});
  for (const ValidationRow& row : validation.rows) {
    const RunCase& run = row.run_case;
    table.AddRow({run.figure.method.name(),
                  std::string(integrators::Name(run.figure.figure)),
                  fmt::format("{}", run.figure.partition.chain_tasks),
                  fmt::format("{}", run.figure.partition.integration_tasks),
                  fmt::format("{}", run.num_lanes),
                  std::string(macrotask::Name(run.wait)),
                  fmt::format("{:.6g}", WorkABlock(run) * 1e6),
                  fmt::format("{}", run.processors), row.condition,
                  fmt::format("{}", row.n), fmt::format("{:.6g}", row.measured),
                  fmt::format("{:.6g}", row.predicted),
                  fmt::format("{:.4f}", row.error())});
  }
  return table.Csv();
}

}  // namespace bench::predict
