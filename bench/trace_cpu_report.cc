#include <fmt/format.h>

#include <map>
#include <set>
#include <vector>

#include "bench/text_table.h"
#include "bench/trace_reports.h"
#include "bench/trace_tasks.h"

namespace bench {
namespace {

using macrotask::TraceRecord;

std::string Percent(std::uint64_t part, std::uint64_t whole) {
  if (whole == 0) return "";
  return fmt::format(
      "{:.1f}", 100 * static_cast<double>(part) / static_cast<double>(whole));
}

std::string List(const std::set<std::uint32_t>& numbers) {
  return fmt::format("{}", fmt::join(numbers, " "));
}

// From where on all records are there, to the end.
std::uint64_t Window(const TraceHistory& history) {
  return history.end - history.complete_from;
}

std::vector<std::uint64_t> Concurrency(
    const TraceHistory& history, const std::vector<RunningPiece>& pieces) {
  return TicksAtConcurrency(pieces, history.complete_from, history.end);
}

std::string ProcessorsTable(const TraceHistory& history,
                            const TraceFilter& filter,
                            const std::vector<RunningPiece>& pieces) {
  struct Processor {
    std::uint64_t records = 0;
    std::set<std::uint32_t> tasks;
    std::vector<RunningPiece> pieces;
  };
  std::map<std::uint16_t, Processor> processors;
  for (const TraceRecord& record : history.records) {
    if (!filter.Task(record.task)) continue;
    ++processors[record.cpu].records;
    processors[record.cpu].tasks.insert(record.task);
  }
  for (const RunningPiece& piece : pieces) {
    processors[piece.cpu].pieces.push_back(piece);
  }
  TextTable table({"cpu", "records", "tasks", "busy (us)", "busy (%)"});
  for (const auto& [cpu, processor] : processors) {
    const std::uint64_t busy =
        Window(history) - Concurrency(history, processor.pieces)[0];
    table.AddRow({std::to_string(cpu), std::to_string(processor.records),
                  List(processor.tasks), UsText(history.UsOf(busy)),
                  Percent(busy, Window(history))});
  }
  return table.Markdown();
}

std::string ConcurrencyTable(const TraceHistory& history,
                             const std::vector<std::uint64_t>& ticks) {
  TextTable table({"tasks running", "time (us)", "time (%)"});
  for (std::size_t n = 0; n < ticks.size(); ++n) {
    table.AddRow({std::to_string(n), UsText(history.UsOf(ticks[n])),
                  Percent(ticks[n], Window(history))});
  }
  return table.Markdown();
}

std::string MigrationsTable(const TraceHistory& history,
                            const TraceFilter& filter) {
  struct Travel {
    std::uint16_t cpu = 0;  // of the last record
    int migrations = 0;
    std::set<std::uint32_t> processors;
  };
  std::map<std::uint32_t, Travel> travels;
  for (const TraceRecord& record : history.records) {
    if (!filter.Task(record.task)) continue;
    Travel& travel = travels[record.task];
    const bool first = travel.processors.empty();
    if (!first && travel.cpu != record.cpu) ++travel.migrations;
    travel.cpu = record.cpu;
    travel.processors.insert(record.cpu);
  }
  TextTable table({"task", "migrations", "processors"});
  for (const auto& [task, travel] : travels) {
    table.AddRow({std::to_string(task), std::to_string(travel.migrations),
                  List(travel.processors)});
  }
  return table.Markdown();
}

}  // namespace

std::string CpuText(const TraceHistory& history, const TraceFilter& filter) {
  std::vector<RunningPiece> pieces = RunningPieces(history);
  std::erase_if(pieces, [&](const RunningPiece& piece) {
    return !filter.Task(piece.task);
  });
  const auto ticks = Concurrency(history, pieces);
  return fmt::format(
      "CPU from {} us to {} us. A processor is busy while a task that was\n"
      "last seen on it runs, that is, does not wait.\n\n{}\n{}\n"
      "Average concurrency: {:.2f}\n\n{}",
      UsText(history.Us(history.complete_from)),
      UsText(history.Us(history.end)), ProcessorsTable(history, filter, pieces),
      ConcurrencyTable(history, ticks), MeanConcurrency(ticks),
      MigrationsTable(history, filter));
}

}  // namespace bench
