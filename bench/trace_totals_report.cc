#include <fmt/format.h>

#include <map>
#include <utility>

#include "bench/text_table.h"
#include "bench/trace_reports.h"
#include "bench/trace_tasks.h"

namespace bench {
namespace {

using macrotask::TraceAction;
using macrotask::TraceRecord;

struct TaskTotals {
  std::uint64_t records = 0;
  std::uint64_t lost = 0;
  std::uint64_t first = 0, last = 0;  // clocks
  std::uint64_t running = 0, asleep = 0;
  std::map<macrotask::ObjectKind, std::uint64_t> waiting;
};

using AllTotals = std::map<std::uint32_t, TaskTotals>;

void AddRecords(const TraceHistory& history, AllTotals* totals) {
  for (const TraceRecord& record : history.records) {
    TaskTotals& task = (*totals)[record.task];
    if (task.records++ == 0) task.first = record.clock;
    task.last = record.clock;
  }
  for (const macrotask::TraceBuffer& buffer : history.trace.buffers) {
    if (buffer.num_lost == 0 || buffer.records.empty()) continue;
    (*totals)[buffer.records.front().task].lost += buffer.num_lost;
  }
}

void AddTimes(const TraceHistory& history, AllTotals* totals) {
  for (const RunningPiece& piece : RunningPieces(history)) {
    (*totals)[piece.task].running += piece.end - piece.begin;
  }
  for (const TraceWait& wait : history.waits) {
    TaskTotals& task = (*totals)[wait.task];
    const std::uint64_t ticks = wait.end - wait.begin;
    if (wait.action == TraceAction::kSleep) task.asleep += ticks;
    if (wait.depth == 0) task.waiting[wait.object.kind] += ticks;
  }
}

std::string TasksTable(const TraceHistory& history, const TraceFilter& filter) {
  AllTotals totals;
  AddRecords(history, &totals);
  AddTimes(history, &totals);
  TextTable table({"task", "value", "records", "lost", "first (us)",
                   "last (us)", "running (us)", "barrier (us)", "event (us)",
                   "lock (us)", "task (us)", "asleep (us)"});
  for (auto& [number, task] : totals) {
    if (!filter.Task(number)) continue;
    const auto value = history.values.find(number);
    const auto us = [&](std::uint64_t ticks) {
      return UsText(history.UsOf(ticks));
    };
    table.AddRow(
        {std::to_string(number),
         value == history.values.end() ? ""
                                       : macrotask::ValueText(value->second),
         std::to_string(task.records), std::to_string(task.lost),
         UsText(history.Us(task.first)), UsText(history.Us(task.last)),
         us(task.running), us(task.waiting[macrotask::ObjectKind::kBarrier]),
         us(task.waiting[macrotask::ObjectKind::kEvent]),
         us(task.waiting[macrotask::ObjectKind::kLock]),
         us(task.waiting[macrotask::ObjectKind::kTask]), us(task.asleep)});
  }
  return table.Markdown();
}

std::string ActionsTable(const TraceHistory& history,
                         const TraceFilter& filter) {
  struct Counts {
    std::uint64_t records = 0, calls = 0;
  };
  std::map<TraceAction, Counts> counts;
  for (const TraceRecord& record : history.records) {
    if (!filter.Record(record)) continue;
    Counts& count = counts[record.action];
    ++count.records;
    count.calls += CallsOf(record);
  }
  TextTable table({"class", "action", "records", "calls"});
  for (const auto& [action, count] : counts) {
    table.AddRow({std::string(Name(macrotask::ClassOf(action))),
                  ActionText(action), std::to_string(count.records),
                  count.calls == 0 ? "" : std::to_string(count.calls)});
  }
  return table.Markdown();
}

}  // namespace

std::string TotalsText(const TraceHistory& history, const TraceFilter& filter) {
  std::string text =
      "TOTALS: running, and waiting for a barrier, an event, a lock, a task; "
      "asleep: of\nthese waits, in the kernel.\n\n" +
      TasksTable(history, filter);
  if (history.num_lost > 0) {
    text +=
        "\nlost: older records, of this task or of earlier ones in the same "
        "buffer; the task\ncounts from its first record that is left.\n";
  }
  return text + "\n" + ActionsTable(history, filter);
}

}  // namespace bench
