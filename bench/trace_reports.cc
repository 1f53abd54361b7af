#include "bench/trace_reports.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <ctime>
#include <set>
#include <utility>
#include <vector>

#include "bench/text_table.h"
#include "bench/trace_tasks.h"

namespace bench {
namespace {

using macrotask::TraceRecord;

std::string DayText(std::int64_t unix_ns) {
  const std::time_t seconds = unix_ns / 1'000'000'000;
  return fmt::format("{:%Y-%m-%d %H:%M:%S} UTC", fmt::gmtime(seconds));
}

std::string LostText(const TraceHistory& history) {
  if (history.num_lost == 0) return "none";
  return fmt::format("{} overwritten; complete from {} us on", history.num_lost,
                     UsText(history.Us(history.complete_from)));
}

std::vector<std::string> ChronRow(const TraceHistory& history,
                                  const TraceRecord& record) {
  return {UsText(history.Us(record.clock)),
          std::to_string(record.task),
          std::to_string(record.cpu),
          std::string(Name(macrotask::ClassOf(record.action))),
          ActionText(record.action),
          ObjectText(ObjectOf(record)),
          DetailText(record)};
}

// Every task of a trace that is not complete waits.
bool AllWait(const std::vector<TaskStatus>& states) {
  bool any = false;
  for (const TaskStatus& status : states) {
    if (status.state == TaskState::kComplete) continue;
    if (status.state != TaskState::kWaiting) return false;
    any = true;
  }
  return any;
}

}  // namespace

std::string UsText(double us) { return fmt::format("{:.3f}", us); }

const char* Name(TraceReport report) {
  constexpr const char* kNames[] = {"totals", "chron", "sync", "cpu", "status"};
  return kNames[static_cast<int>(report)];
}

std::string TraceHeader(const TraceHistory& history) {
  std::set<std::uint32_t> tasks;
  for (const TaskSpan& span : history.spans) tasks.insert(span.task);
  const TraceRecord classes = {0, history.trace.classes, 0, 0,
                               macrotask::TraceAction::kTraceClasses};
  return fmt::format(
      "begun:      {}\n"
      "taken:      {} us later\n"
      "records:    {} of {} tasks\n"
      "lost:       {}\n"
      "recorded:   {}\n"
      "processors: {}\n",
      DayText(history.trace.first_unix_ns),
      UsText(history.Us(history.trace.last_clock)), history.records.size(),
      tasks.size(), LostText(history), DetailText(classes),
      history.trace.num_processors);
}

std::string ChronText(const TraceHistory& history, const TraceFilter& filter) {
  TextTable table(
      {"time (us)", "task", "cpu", "class", "action", "object", "detail"});
  for (const TraceRecord& record : history.records) {
    if (filter.Record(record)) table.AddRow(ChronRow(history, record));
  }
  return "CHRON: the records in time order.\n\n" + table.Markdown();
}

std::string ChronCsv(const TraceHistory& history, const TraceFilter& filter) {
  TextTable table({"time_us", "task", "cpu", "class", "action", "object",
                   "detail", "data"});
  for (const TraceRecord& record : history.records) {
    if (!filter.Record(record)) continue;
    std::vector<std::string> row = ChronRow(history, record);
    row.push_back(std::to_string(record.data));
    table.AddRow(std::move(row));
  }
  return table.Csv();
}

std::string StatusText(const TraceHistory& history, const TraceFilter& filter) {
  TextTable table({"task", "value", "state", "since (us)"});
  const std::vector<TaskStatus> states = StatesAtEnd(history);
  for (const TaskStatus& status : states) {
    if (!filter.Task(status.task)) continue;
    const auto value = history.values.find(status.task);
    table.AddRow({std::to_string(status.task),
                  value == history.values.end()
                      ? ""
                      : macrotask::ValueText(value->second),
                  StateText(status), UsText(history.Us(status.since))});
  }
  return fmt::format(
      "STATUS at {} us: the tasks at the end of the trace.\n\n{}{}",
      UsText(history.Us(history.end)), table.Markdown(),
      AllWait(states) ? "\nEvery task that is not complete waits.\n" : "");
}

std::string TraceReportText(TraceReport report, const TraceHistory& history,
                            const TraceFilter& filter) {
  switch (report) {
    case TraceReport::kTotals:
      return TotalsText(history, filter);
    case TraceReport::kSync:
      return SyncText(history, filter);
    case TraceReport::kCpu:
      return CpuText(history, filter);
    case TraceReport::kStatus:
      return StatusText(history, filter);
    case TraceReport::kChron:
      break;
  }
  return ChronText(history, filter);
}

}  // namespace bench
