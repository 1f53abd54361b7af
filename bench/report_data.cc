// A reproduction for other programs: CSV and JSON.

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <utility>

#include "bench/gains.h"
#include "bench/report.h"
#include "bench/text_table.h"

namespace bench {
namespace {

int LaneCount(const LaneTables& tables) {
  return static_cast<int>(tables.lanes);
}

nlohmann::json RowJson(const Reproduction& r, const LaneTables& tables,
                       const TableRow& row) {
  nlohmann::json json = {{"lanes", LaneCount(tables)},
                         {"processors", row.processors()},
                         {"chain_tasks", row.partition.chain_tasks},
                         {"integration_tasks", row.partition.integration_tasks},
                         {"block", row.block_size},
                         {"same_bits_as_serial", row.same_bits},
                         {"steps_run", row.steps},
                         {"seconds", row.seconds},
                         {"S_a_steps", StepSpeedup(r, row.block_size)}};
  if (row.measured()) {
    const Gain S_p = SpeedupOf(SerialRow(tables, row.block_size), row);
    const double S_a = ClockSpeedup(tables, row.block_size);
    json["T"] = MedianT(row);
    json["S_p"] = S_p.value;
    json["S_p_interval"] = {S_p.interval.low, S_p.interval.high};
    json["S_a_clock"] = S_a;
    json["S_T"] = S_p.value * S_a;
  } else {
    json["needs_processors"] = row.processors();
    if (row.predicted) {
      const predict::PredictedRow& predicted = *row.predicted;
      const auto ranged = [](const predict::Ranged& value) {
        return nlohmann::json{{"median", value.value},
                              {"range", {value.range.low, value.range.high}}};
      };
      json["predicted"] = {{"T", ranged(predicted.T)},
                           {"S_p", ranged(predicted.S_p)},
                           {"S_a", predicted.S_a},
                           {"S_T", ranged(predicted.S_T)}};
    }
  }
  if (row.paper != nullptr) {
    json["paper"] = {{"T", row.paper->T},
                     {"S_p", row.paper->S_p},
                     {"S_a", row.paper->S_a},
                     {"S_T", row.paper->S_T}};
  }
  return json;
}

nlohmann::json SweepJson(const MethodSweep& sweep) {
  nlohmann::json points = nlohmann::json::array();
  for (const SweepPoint& point : sweep.points) {
    points.push_back({{"steps", point.steps}, {"error", point.error}});
  }
  return {{"method", sweep.method.name()},
          {"steps_at_target", sweep.steps_at_target},
          {"slope", sweep.fit.slope},
          {"intercept", sweep.fit.intercept},
          {"points", std::move(points)}};
}

}  // namespace

std::string ReportCsv(const Reproduction& r) {
  TextTable table({"lanes",
                   "processors",
                   "chain_tasks",
                   "integration_tasks",
                   "block",
                   "T_s",
                   "T_low_s",
                   "T_high_s",
                   "S_p",
                   "S_p_low",
                   "S_p_high",
                   "S_a_steps",
                   "S_a_clock",
                   "S_T",
                   "same_bits_as_serial",
                   "needs_processors",
                   "predicted_T_s",
                   "predicted_S_p",
                   "predicted_S_T",
                   "paper_T_s",
                   "paper_S_p",
                   "paper_S_a",
                   "paper_S_T"});
  for (const LaneTables& tables : r.lanes) {
    for (const TableRow& row : tables.rows) {
      std::vector<std::string> cells;
      for (const int n :
           {LaneCount(tables), row.processors(), row.partition.chain_tasks,
            row.partition.integration_tasks, row.block_size}) {
        cells.push_back(fmt::format("{}", n));
      }
      const auto number = [](double x) { return fmt::format("{:.6g}", x); };
      const std::string S_a_steps = number(StepSpeedup(r, row.block_size));
      if (row.measured()) {
        const Gain S_p = SpeedupOf(SerialRow(tables, row.block_size), row);
        const Interval range = MedianInterval(T(row));
        const double S_a = ClockSpeedup(tables, row.block_size);
        for (const double x : {MedianT(row), range.low, range.high, S_p.value,
                               S_p.interval.low, S_p.interval.high}) {
          cells.push_back(number(x));
        }
        cells.insert(cells.end(),
                     {S_a_steps, number(S_a), number(S_p.value * S_a)});
      } else {
        cells.insert(cells.end(), 6, "");
        cells.insert(cells.end(), {S_a_steps, "", ""});
      }
      cells.push_back(row.same_bits ? "true" : "false");
      cells.push_back(row.measured() ? ""
                                     : fmt::format("{}", row.processors()));
      if (row.predicted) {
        for (const double x : {row.predicted->T.value, row.predicted->S_p.value,
                               row.predicted->S_T.value}) {
          cells.push_back(number(x));
        }
      } else {
        cells.insert(cells.end(), 3, "");
      }
      for (const auto figure :
           {&PaperRow::T, &PaperRow::S_p, &PaperRow::S_a, &PaperRow::S_T}) {
        cells.push_back(row.paper == nullptr ? "" : number(row.paper->*figure));
      }
      table.AddRow(std::move(cells));
    }
  }
  return table.Csv();
}

std::string ReportJson(const Reproduction& r) {
  nlohmann::json json = {{"version", r.machine.version},
                         {"git_hash", r.machine.git_hash},
                         {"machine",
                          {{"cpu", r.machine.cpu},
                           {"processors", r.machine.processors},
                           {"kernel", r.machine.kernel},
                           {"compiler", r.machine.compiler},
                           {"flags", r.machine.flags},
                           {"placement", r.placement}}},
                         {"wait", Name(r.wait.kind)},
                         {"hold_time_ns", r.wait.hold_time.count()},
                         {"target_error", kTargetError}};
  for (const MethodSweep& sweep : r.sweeps) {
    json["sweeps"].push_back(SweepJson(sweep));
  }
  for (const LaneTables& tables : r.lanes) {
    for (const TableRow& row : tables.rows) {
      json["table2"].push_back(RowJson(r, tables, row));
    }
    json["lift"].push_back({{"lanes", LaneCount(tables)},
                            {"steps", tables.lift.steps},
                            {"error", tables.lift.error},
                            {"seconds", tables.lift.seconds}});
  }
  for (const Cost& cost : r.costs) {
    json["costs"].push_back(
        {{"name", cost.name}, {"with", cost.with}, {"seconds", cost.seconds}});
  }
  return json.dump(2) + "\n";
}

}  // namespace bench
