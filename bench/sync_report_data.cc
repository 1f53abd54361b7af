// What a laboratory run has found, for other programs: CSV and JSON.

#include <fmt/format.h>
#include <unistd.h>

#include <cstdlib>
#include <ctime>
#include <nlohmann/json.hpp>
#include <utility>

#include "bench/sync_report.h"
#include "bench/text_table.h"

namespace bench {
namespace {

using Json = nlohmann::json;

constexpr double kNano = 1e9;

std::string NumberText(double seconds) {
  return fmt::format("{:.6g}", seconds * kNano);
}

void AddSummary(const std::optional<Summary>& summary,
                std::vector<std::string>* cells) {
  if (!summary) {
    cells->insert(cells->end(), 5, "");
    return;
  }
  for (const double seconds :
       {summary->median, summary->interval.low, summary->interval.high,
        summary->min, summary->p95}) {
    cells->push_back(NumberText(seconds));
  }
}

std::vector<std::string> CsvHeader() {
  std::vector<std::string> header = {"family",  "construct", "by",      "tasks",
                                     "work_us", "skew",      "distance"};
  for (const char* what : {"overhead", "latency_first", "latency_last"}) {
    for (const char* figure : {"", "_low", "_high", "_min", "_p95"}) {
      header.push_back(fmt::format("{}{}_ns", what, figure));
    }
  }
  header.insert(header.end(), {"fairness", "call_ns", "cpu_ns", "calls", "n",
                               "dropped_distance", "dropped_stolen",
                               "dropped_switched", "missing"});
  return header;
}

std::vector<std::string> CsvCells(const SyncRow& row) {
  const Variant& variant = row.variant;
  std::vector<std::string> cells = {std::string(Name(variant.family)),
                                    variant.construct,
                                    variant.by,
                                    fmt::format("{}", variant.num_tasks),
                                    fmt::format("{:g}", variant.work),
                                    std::string(Name(variant.skew)),
                                    std::string(Name(row.distance))};
  for (const auto* summary : {&row.overhead, &row.first, &row.last}) {
    AddSummary(*summary, &cells);
  }
  const bool any = row.overhead.has_value();
  cells.push_back(row.fairness ? fmt::format("{:.4g}", row.fairness->median)
                               : "");
  cells.push_back(any ? NumberText(row.total) : "");
  cells.push_back(any ? NumberText(row.cpu) : "");
  cells.push_back(fmt::format("{}", row.calls));
  for (const int n : {any ? row.overhead->n : 0, row.dropped.distance,
                      row.dropped.stolen, row.dropped.switched}) {
    cells.push_back(fmt::format("{}", n));
  }
  cells.push_back(variant.missing);
  return cells;
}

std::string OptionalText(const std::optional<double>& seconds) {
  return seconds ? NumberText(*seconds) : "";
}

std::string BreakEvenCsv(const BreakEven& even) {
  TextTable table({"construct", "by", "distance", "work_50_ns",
                   "work_50_low_ns", "work_50_high_ns", "work_90_ns",
                   "work_90_low_ns", "work_90_high_ns", "n", "dropped"});
  for (const BreakEvenRow& row : even.rows) {
    std::vector<std::string> cells = {row.construct, row.by,
                                      std::string(Name(row.distance))};
    for (const WorkSummary* work : {&row.half, &row.ninety}) {
      for (const auto& seconds : {work->median, work->low, work->high}) {
        cells.push_back(OptionalText(seconds));
      }
    }
    cells.push_back(fmt::format("{}", row.n));
    cells.push_back(fmt::format("{}", row.dropped));
    table.AddRow(std::move(cells));
  }
  return table.Csv();
}

Json SummaryJson(const Summary& summary) {
  return {{"median", summary.median * kNano},
          {"interval",
           {summary.interval.low * kNano, summary.interval.high * kNano}},
          {"min", summary.min * kNano},
          {"p95", summary.p95 * kNano},
          {"n", summary.n}};
}

// The keys that Google Benchmark has, then ours.
Json RowJson(const SyncRow& row) {
  const Variant& variant = row.variant;
  Json json = {{"name", RowName(row)},
               {"run_name", RowName(row)},
               {"run_type", "aggregate"},
               {"aggregate_name", "median"},
               {"aggregate_unit", "time"},
               {"threads", variant.num_tasks},
               {"iterations", row.calls},
               {"time_unit", "ns"},
               {"family", Name(variant.family)},
               {"construct", variant.construct},
               {"by", variant.by},
               {"work_us", variant.work},
               {"skew", Name(variant.skew)},
               {"distance", Name(row.distance)},
               {"dropped",
                {{"distance", row.dropped.distance},
                 {"stolen", row.dropped.stolen},
                 {"switched", row.dropped.switched}}}};
  if (!row.overhead) {
    json["error_occurred"] = true;
    json["error_message"] =
        variant.missing.empty() ? "all samples disturbed" : variant.missing;
    return json;
  }
  json["real_time"] = row.total * kNano;
  json["cpu_time"] = row.cpu * kNano;
  json["repetitions"] = row.overhead->n;
  json["overhead"] = SummaryJson(*row.overhead);
  if (row.first) json["latency_first"] = SummaryJson(*row.first);
  if (row.last) json["latency_last"] = SummaryJson(*row.last);
  if (row.fairness) json["fairness"] = row.fairness->median;
  return json;
}

Json WorkJson(const WorkSummary& work) {
  const auto number = [](const std::optional<double>& seconds) {
    return seconds ? Json(*seconds * kNano) : Json(nullptr);
  };
  return {{"median", number(work.median)},
          {"interval", {number(work.low), number(work.high)}}};
}

Json BreakEvenJson(const BreakEvenRow& row) {
  Json curve = Json::array();
  for (const CurvePoint& point : row.curve) {
    curve.push_back({{"work", point.work * kNano},
                     {"efficiency", point.efficiency},
                     {"interval", {point.interval.low, point.interval.high}}});
  }
  std::string name = fmt::format("break-even/{}/{}", row.construct, row.by);
  if (row.distance != Distance::kOnly) {
    name += fmt::format("/{}", Name(row.distance));
  }
  return {{"name", name},
          {"run_name", name},
          {"run_type", "aggregate"},
          {"aggregate_name", "median"},
          {"time_unit", "ns"},
          {"real_time", WorkJson(row.half)["median"]},
          {"distance", Name(row.distance)},
          {"work_50", WorkJson(row.half)},
          {"work_90", WorkJson(row.ninety)},
          {"repetitions", row.n},
          {"dropped", row.dropped},
          {"points_dropped", row.points_dropped},
          {"curve", std::move(curve)}};
}

std::string Now() {
  const std::time_t now = std::time(nullptr);
  std::tm local{};
  localtime_r(&now, &local);
  char text[64];
  const std::size_t size =
      std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%S%z", &local);
  return std::string(text, size);
}

Json ContextJson(const SyncResult& r) {
  char host[256] = "";
  gethostname(host, sizeof host - 1);
  double load[3] = {0, 0, 0};
  if (getloadavg(load, 3) < 0) load[0] = load[1] = load[2] = 0;
  Json context = {{"date", Now()},
                  {"host_name", host},
                  {"executable", "macrotask sync"},
                  {"num_cpus", r.machine.processors},
                  {"caches", Json::array()},
                  {"load_avg", load},
                  {"cpu", r.machine.cpu},
                  {"kernel", r.machine.kernel},
                  {"compiler", r.machine.compiler},
                  {"flags", r.machine.flags},
                  {"version", r.machine.version},
                  {"git_hash", r.machine.git_hash},
                  {"placement", Name(r.axes.placement)},
                  {"hold_time_ns", r.axes.hold_time.count()},
                  {"repetitions", r.repetitions}};
  if (r.clocks) {
    context["clocks"] = {{"agree", r.clocks->agree()},
                         {"there", r.clocks->there * kNano},
                         {"back", r.clocks->back * kNano}};
  }
  const DistanceSplit& split = r.break_even ? r.break_even->split : r.split;
  if (split.has_two()) context["far_from_ns"] = split.threshold * kNano;
  return context;
}

}  // namespace

std::string SyncCsv(const SyncResult& result) {
  if (result.break_even) return BreakEvenCsv(*result.break_even);
  TextTable table(CsvHeader());
  for (const SyncRow& row : result.rows) table.AddRow(CsvCells(row));
  return table.Csv();
}

std::string SyncJson(const SyncResult& result) {
  Json json = {{"context", ContextJson(result)}, {"benchmarks", Json::array()}};
  for (const SyncRow& row : result.rows) {
    json["benchmarks"].push_back(RowJson(row));
  }
  if (result.break_even) {
    for (const BreakEvenRow& row : result.break_even->rows) {
      json["benchmarks"].push_back(BreakEvenJson(row));
    }
  }
  return json.dump(2) + "\n";
}

}  // namespace bench
