#include "bench/trace_command.h"

#include <map>
#include <stdexcept>
#include <string>

#include "bench/command_options.h"
#include "bench/output_file.h"
#include "bench/trace_names.h"
#include "bench/trace_perfetto.h"
#include "macrotask/trace_file.h"

namespace bench {
namespace {

std::map<std::string, macrotask::TraceClass> Classes() {
  std::map<std::string, macrotask::TraceClass> classes;
  for (std::uint32_t bit = 1; bit < macrotask::kAllTraceClasses; bit *= 2) {
    const auto trace_class = static_cast<macrotask::TraceClass>(bit);
    classes.emplace(Name(trace_class), trace_class);
  }
  return classes;
}

}  // namespace

void TraceCommand::Add(CLI::App* app) {
  app->add_option("FILE", file_, "The history trace, as BUFDUMP writes it")
      ->required();
  AddChoices<TraceReport>(
      app, "--report", &reports_,
      ByName({TraceReport::kTotals, TraceReport::kChron, TraceReport::kSync,
              TraceReport::kCpu, TraceReport::kStatus}),
      "What to print: totals by task and action, chron: every record in time "
      "order, sync: waits by object and who let whom wait, cpu: processors and "
      "concurrency, status: the tasks at the end (by default all but chron)");
  app->add_option("--task", filter_.tasks,
                  "Only these tasks, in all reports; who came last at a "
                  "barrier, posted, or waited for a lock's holder is still "
                  "found among all")
      ->allow_extra_args(false)
      ->option_text("N ...");
  AddChoices<macrotask::TraceClass>(
      app, "--class", &filter_.classes, Classes(),
      "Only records of these classes: in chron and --csv, the actions of "
      "totals, the calls and waits of sync; cpu, status and --perfetto always "
      "take all");
  AddRepeated(
      app, "--action",
      [this](const std::string& text) {
        filter_.actions.push_back(ActionCalled(text));
      },
      "Only records of these actions, as chron calls them, such as BARSYNC or "
      "\"user 65\"; where, see --class")
      ->option_text("NAME ...");
  AddFile(app, "--csv", &csv_,
          "Write the records of chron to this file as CSV (- for the standard "
          "output, instead of the reports)");
  AddFile(app, "--perfetto", &perfetto_,
          "Write the trace to this file as JSON for ui.perfetto.dev or "
          "chrome://tracing (- likewise)");
}

void TraceCommand::CheckOutputs() const {
  for (const std::string& path : {csv_, perfetto_}) {
    if (path.empty()) continue;
    if (path == file_) {
      throw std::invalid_argument("'" + path + "' is the trace itself");
    }
    CheckOutput(path);
  }
  if (!csv_.empty() && csv_ == perfetto_) {
    throw std::invalid_argument("--csv and --perfetto both write to '" + csv_ +
                                "'");
  }
}

void TraceCommand::Run() const {
  CheckOutputs();
  const TraceHistory history = MakeHistory(macrotask::ReadTrace(file_));
  std::vector<TraceReport> reports = reports_;
  if (reports.empty()) {
    reports = {TraceReport::kTotals, TraceReport::kSync, TraceReport::kCpu,
               TraceReport::kStatus};
  }
  std::string text = TraceHeader(history);
  for (const TraceReport report : reports) {
    text += "\n" + TraceReportText(report, history, filter_);
  }
  if (csv_ != "-" && perfetto_ != "-") WriteOutput("-", text);
  if (!csv_.empty()) WriteOutput(csv_, ChronCsv(history, filter_));
  if (!perfetto_.empty()) WriteOutput(perfetto_, PerfettoJson(history));
}

}  // namespace bench
