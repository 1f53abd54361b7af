#include "bench/trace_history.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <utility>

namespace bench {
namespace {

using macrotask::TraceAction;
using macrotask::TraceBuffer;
using macrotask::TraceRecord;

void SetBounds(TraceHistory* history) {
  const auto& records = history->records;
  history->begin = history->trace.first_clock;
  history->end = std::max(history->trace.last_clock, history->begin);
  if (!records.empty()) {
    history->begin = std::min(history->begin, records.front().clock);
    history->end = std::max(history->end, records.back().clock);
  }
  history->complete_from = history->begin;
  for (const TraceBuffer& buffer : history->trace.buffers) {
    if (buffer.num_lost == 0) continue;
    history->num_lost += buffer.num_lost;
    history->complete_from = std::max(
        history->complete_from,
        buffer.records.empty() ? history->end : buffer.records.front().clock);
  }
}

void SetValues(TraceHistory* history) {
  for (const TraceBuffer& buffer : history->trace.buffers) {
    if (buffer.value != 0) history->values[buffer.task] = buffer.value;
  }
  for (const TraceRecord& record : history->records) {
    if (record.action == TraceAction::kTaskBegin) {
      history->values[record.task] = record.data;
    }
  }
}

bool Records(std::uint32_t classes, macrotask::TraceClass trace_class) {
  return (classes & static_cast<std::uint32_t>(trace_class)) != 0;
}

// The spans in one buffer. Only the last task of a buffer may still be running
// at the end of the trace: the others had to end before it could begin.
void AddSpans(const TraceBuffer& buffer, std::uint64_t end_of_trace,
              bool ends_are_recorded, std::vector<TaskSpan>* spans) {
  const std::size_t first = spans->size();
  bool open = false;
  for (const TraceRecord& record : buffer.records) {
    const bool begins = record.action == TraceAction::kTaskBegin;
    const bool other =
        spans->size() == first || spans->back().task != record.task;
    if (begins || other) {
      if (open) spans->back().ended = true;
      spans->push_back(
          {record.task, record.clock, record.clock, begins, false});
      open = true;
    }
    if (!open) continue;  // after the end of a body
    spans->back().end = std::max(spans->back().end, record.clock);
    if (record.action == TraceAction::kTaskEnd) {
      spans->back().ended = true;
      open = false;
    }
  }
  if (open && ends_are_recorded) spans->back().end = end_of_trace;
}

void SetSpans(TraceHistory* history) {
  const bool ends_are_recorded =
      Records(history->trace.classes, macrotask::TraceClass::kTasks);
  for (const TraceBuffer& buffer : history->trace.buffers) {
    AddSpans(buffer, history->end, ends_are_recorded, &history->spans);
  }
  std::stable_sort(history->spans.begin(), history->spans.end(),
                   [](const TaskSpan& a, const TaskSpan& b) {
                     return std::pair(a.task, a.begin) <
                            std::pair(b.task, b.begin);
                   });
}

}  // namespace

TraceHistory MakeHistory(macrotask::Trace trace) {
  TraceHistory history;
  history.trace = std::move(trace);
  history.records = InOrderOfTime(history.trace);
  SetBounds(&history);
  history.waits = PairWaits(history.records, history.end);
  SetValues(&history);
  SetSpans(&history);
  return history;
}

std::string TaskText(const TraceHistory& history, std::uint32_t task) {
  const auto value = history.values.find(task);
  const std::string text =
      value == history.values.end() ? "" : macrotask::ValueText(value->second);
  return text.empty() ? fmt::format("task {}", task)
                      : fmt::format("task {} ({})", task, text);
}

}  // namespace bench
