#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "bench/predict/prediction_table.h"
#include "bench/text_table.h"

namespace bench::predict {
namespace {

// Seconds with the unit that suits the whole table.
struct Unit {
  const char* name;
  double per_second;
};
Unit UnitFor(const std::vector<PredictedRow>& rows) {
  double greatest = 0;
  for (const PredictedRow& row : rows) {
    greatest = std::max(greatest, row.T.value);
  }
  if (greatest < 10e-3) return {"us", 1e6};
  return greatest < 10 ? Unit{"ms", 1e3} : Unit{"s", 1};
}

std::string Speedup(const Ranged& s) {
  return fmt::format("{:.2f} [{:.2f}, {:.2f}]", s.value, s.range.low,
                     s.range.high);
}

std::string Percent(double share) { return fmt::format("{:.1f}", 100 * share); }

std::vector<std::string> Cells(const PredictedRow& row, const Unit& unit,
                               bool paper) {
  std::vector<std::string> cells = {
      fmt::format("{}", row.processors),
      row.method.name(),
      fmt::format("{}", row.partition.chain_tasks),
      fmt::format("{}", row.partition.integration_tasks),
      fmt::format("{:.1f} [{:.1f}, {:.1f}]", row.T.value * unit.per_second,
                  row.T.range.low * unit.per_second,
                  row.T.range.high * unit.per_second),
      Speedup(row.S_p),
      fmt::format("{:.3f}", row.S_a),
      Speedup(row.S_T)};
  for (const double limit :
       {row.critical_path, row.work_bound, row.free_sync}) {
    cells.push_back(fmt::format("{:.2f}", limit));
  }
  for (const double share : {row.where.compute, row.where.imbalance,
                             row.where.sync, row.where.queue}) {
    cells.push_back(Percent(share));
  }
  if (!paper) return cells;
  for (const auto figure : {&PaperRow::S_p, &PaperRow::S_T}) {
    cells.push_back(
        row.paper == nullptr ? "" : fmt::format("{:.4g}", row.paper->*figure));
  }
  return cells;
}

std::vector<PredictedRow> RowsOn(const std::vector<PredictedRow>& rows,
                                 int processors) {
  std::vector<PredictedRow> own;
  for (const PredictedRow& row : rows) {
    if (row.processors == processors) own.push_back(row);
  }
  return own;
}

std::string BestSentences(const std::vector<PredictedRow>& rows) {
  std::string text;
  std::set<int> done;
  for (const PredictedRow& row : rows) {
    if (!done.insert(row.processors).second) continue;
    const auto own = RowsOn(rows, row.processors);
    const PredictedRow &best = BestOf(own), &rule = RuleOf(own);
    text +=
        fmt::format("{:>6} processor{} {}, S_T {:.2f}", row.processors,
                    row.processors == 1 ? ": " : "s:", ConfigurationText(best),
                    best.S_T.value);
    text += &best == &rule
                ? "; so says the rule\n"
                : fmt::format("; by the rule {}, {:.2f}\n",
                              ConfigurationText(rule), rule.S_T.value);
  }
  return text;
}

}  // namespace

std::string ConfigurationText(const PredictedRow& row) {
  return fmt::format("{} {}x{}", row.method.name(), row.partition.chain_tasks,
                     row.partition.integration_tasks);
}

std::string TableText(const std::vector<PredictedRow>& rows) {
  bool paper = false;
  for (const PredictedRow& row : rows) paper = paper || row.paper != nullptr;
  const Unit unit = UnitFor(rows);
  std::vector<std::string> header = {"processors",
                                     "method",
                                     "m^",
                                     "p^",
                                     fmt::format("T ({})", unit.name),
                                     "S_p",
                                     "S_a",
                                     "S_T",
                                     "critical path",
                                     "work bound",
                                     "free sync",
                                     "compute %",
                                     "imbalance %",
                                     "sync %",
                                     "queue %"};
  if (paper) header.insert(header.end(), {"paper S_p", "S_T"});
  TextTable table(header);
  for (const PredictedRow& row : rows) {
    table.AddRow(Cells(row, unit, paper));
  }
  return table.Markdown() +
         "\nBrackets: the middle 95 % of the replications. S_p if there were "
         "processors without\nend and nothing cost to wait: critical path; if "
         "nobody ever waited: work bound; on\nthese processors, if nothing "
         "cost to wait: free sync. imbalance: until the last one\ncame; sync: "
         "from then on; queue: others had the processor.\n\nBest, and by the "
         "paper's rule (most tasks, of these the most spatial parallelism,\n"
         "then the most accurate method):\n\n" +
         BestSentences(rows);
}

std::string TableCsv(const std::vector<PredictedRow>& rows) {
  TextTable table({"processors",        "method",        "chain_tasks",
                   "integration_tasks", "T_s",           "T_low_s",
                   "T_high_s",          "S_p",           "S_p_low",
                   "S_p_high",          "S_a",           "S_T",
                   "S_T_low",           "S_T_high",      "S_p_critical_path",
                   "S_p_work_bound",    "S_p_free_sync", "compute",
                   "imbalance",         "sync",          "queue",
                   "paper_S_p",         "paper_S_T"});
  const auto number = [](double x) { return fmt::format("{:.6g}", x); };
  for (const PredictedRow& row : rows) {
    std::vector<std::string> cells = {
        fmt::format("{}", row.processors), row.method.name(),
        fmt::format("{}", row.partition.chain_tasks),
        fmt::format("{}", row.partition.integration_tasks)};
    for (const double x :
         {row.T.value, row.T.range.low, row.T.range.high, row.S_p.value,
          row.S_p.range.low, row.S_p.range.high, row.S_a, row.S_T.value,
          row.S_T.range.low, row.S_T.range.high, row.critical_path,
          row.work_bound, row.free_sync, row.where.compute, row.where.imbalance,
          row.where.sync, row.where.queue}) {
      cells.push_back(number(x));
    }
    for (const auto figure : {&PaperRow::S_p, &PaperRow::S_T}) {
      cells.push_back(row.paper == nullptr ? "" : number(row.paper->*figure));
    }
    table.AddRow(std::move(cells));
  }
  return table.Csv();
}

std::string PaperText(const std::vector<PredictedRow>& rows) {
  TextTable table({"processors", "method", "m^", "p^", "S_p", "paper",
                   "error (%)", "S_T", "paper", "error (%)"});
  double worst = 0;
  for (const PredictedRow& row : rows) {
    if (row.paper == nullptr) continue;
    const double p = row.S_p.value / row.paper->S_p - 1;
    const double t = row.S_T.value / row.paper->S_T - 1;
    worst = std::max({worst, std::abs(p), std::abs(t)});
    table.AddRow({fmt::format("{}", row.processors), row.method.name(),
                  fmt::format("{}", row.partition.chain_tasks),
                  fmt::format("{}", row.partition.integration_tasks),
                  fmt::format("{:.2f}", row.S_p.value),
                  fmt::format("{:.4g}", row.paper->S_p), Percent(p),
                  fmt::format("{:.2f}", row.S_T.value),
                  fmt::format("{:.4g}", row.paper->S_T), Percent(t)});
  }
  return table.Markdown() +
         fmt::format("\nGoal: within 5 % of the paper. Worst {:.1f} %: {}.\n",
                     worst * 100, worst < 0.05 ? "met" : "missed");
}

}  // namespace bench::predict
