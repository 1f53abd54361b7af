#include "bench/trace_tasks.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <utility>

namespace bench {
namespace {

using macrotask::TraceAction;
using macrotask::TraceRecord;

using Clocks = std::pair<std::uint64_t, std::uint64_t>;

// What one task did, in time order.
struct TaskLine {
  std::vector<TraceRecord> records;
  std::vector<Clocks> waits;  // the outermost ones
};

std::map<std::uint32_t, TaskLine> TaskLines(const TraceHistory& history) {
  std::map<std::uint32_t, TaskLine> lines;
  for (const TraceRecord& record : history.records) {
    lines[record.task].records.push_back(record);
  }
  for (const TraceWait& wait : history.waits) {
    if (wait.depth == 0)
      lines[wait.task].waits.push_back({wait.begin, wait.end});
  }
  return lines;
}

void Append(const RunningPiece& piece, std::vector<RunningPiece>* pieces) {
  if (piece.begin == piece.end) return;
  const bool goes_on = !pieces->empty() && pieces->back().task == piece.task &&
                       pieces->back().cpu == piece.cpu &&
                       pieces->back().end == piece.begin;
  if (goes_on) {
    pieces->back().end = piece.end;
  } else {
    pieces->push_back(piece);
  }
}

void AppendPieces(const TaskSpan& span, const TaskLine& line,
                  std::vector<RunningPiece>* pieces) {
  auto wait = std::lower_bound(
      line.waits.begin(), line.waits.end(), span.begin,
      [](const Clocks& clocks, std::uint64_t t) { return clocks.first < t; });
  auto record = std::lower_bound(
      line.records.begin(), line.records.end(), span.begin,
      [](const TraceRecord& r, std::uint64_t t) { return r.clock < t; });
  for (; record != line.records.end() && record->clock < span.end; ++record) {
    while (wait != line.waits.end() && wait->second <= record->clock) ++wait;
    const bool waits = wait != line.waits.end() && wait->first <= record->clock;
    if (waits) continue;
    const auto next = std::next(record);
    const std::uint64_t end =
        next == line.records.end() ? span.end : std::min(next->clock, span.end);
    Append({span.task, record->cpu, record->clock, end}, pieces);
  }
}

TaskStatus StatusOf(const TaskSpan& span) {
  const auto state = span.ended ? TaskState::kComplete : TaskState::kRunning;
  return {span.task, state, {}, false, span.ended ? span.end : span.begin};
}

// Takes the next wait of a task that has not ended into account.
void Apply(const TraceWait& wait, TaskStatus* status) {
  if (wait.finished) {
    if (status->state == TaskState::kRunning) {
      status->since = std::max(status->since, wait.end);
    }
    return;
  }
  if (wait.action != TraceAction::kSleep) {
    status->state = TaskState::kWaiting;
    status->object = wait.object;
    status->since = wait.begin;
    return;
  }
  status->sleeps = true;
  if (status->state == TaskState::kRunning) {
    status->state = TaskState::kSleeping;
    status->since = wait.begin;
  }
}

}  // namespace

std::vector<RunningPiece> RunningPieces(const TraceHistory& history) {
  const auto lines = TaskLines(history);
  std::vector<RunningPiece> pieces;
  for (const TaskSpan& span : history.spans) {
    AppendPieces(span, lines.at(span.task), &pieces);
  }
  return pieces;
}

std::vector<std::uint64_t> TicksAtConcurrency(
    const std::vector<RunningPiece>& pieces, std::uint64_t begin,
    std::uint64_t end) {
  std::map<std::uint64_t, int> changes;  // clock: how many more run
  changes[begin] += 0;
  changes[std::max(begin, end)] += 0;
  for (const RunningPiece& piece : pieces) {
    ++changes[std::clamp(piece.begin, begin, std::max(begin, end))];
    --changes[std::clamp(piece.end, begin, std::max(begin, end))];
  }
  std::vector<std::uint64_t> ticks(1, 0);
  std::size_t running = 0;
  for (auto change = changes.begin(); std::next(change) != changes.end();
       ++change) {
    running += static_cast<std::size_t>(change->second);
    if (ticks.size() <= running) ticks.resize(running + 1, 0);
    ticks[running] += std::next(change)->first - change->first;
  }
  return ticks;
}

double MeanConcurrency(const std::vector<std::uint64_t>& ticks) {
  double total = 0, ran = 0;
  for (std::size_t n = 0; n < ticks.size(); ++n) {
    total += static_cast<double>(ticks[n]);
    ran += static_cast<double>(n) * static_cast<double>(ticks[n]);
  }
  return total == 0 ? 0 : ran / total;
}

std::vector<TaskStatus> StatesAtEnd(const TraceHistory& history) {
  std::map<std::uint32_t, TaskStatus> states;
  for (const TaskSpan& span : history.spans) {
    states.insert_or_assign(span.task, StatusOf(span));
  }
  for (const TraceWait& wait : history.waits) {
    const auto status = states.find(wait.task);
    if (status == states.end()) continue;
    if (status->second.state == TaskState::kComplete) continue;
    Apply(wait, &status->second);
  }
  for (const TraceRecord& record : history.records) {
    if (record.action != TraceAction::kTaskStart) continue;
    const TaskState state =
        history.num_lost == 0 ? TaskState::kReady : TaskState::kLost;
    states.insert(
        {record.object(), {record.object(), state, {}, false, record.clock}});
  }
  std::vector<TaskStatus> sorted;
  for (const auto& [task, status] : states) sorted.push_back(status);
  return sorted;
}

std::string StateText(const TaskStatus& status) {
  switch (status.state) {
    case TaskState::kReady:
      return "ready";
    case TaskState::kRunning:
      return "running";
    case TaskState::kSleeping:
      return "sleeping";
    case TaskState::kComplete:
      return "complete";
    case TaskState::kLost:
      return "records lost";
    case TaskState::kWaiting:
      break;
  }
  return "waiting for " + ObjectText(status.object) +
         (status.sleeps ? ", asleep" : "");
}

}  // namespace bench
