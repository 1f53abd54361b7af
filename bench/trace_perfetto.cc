#include "bench/trace_perfetto.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "bench/trace_sync.h"

namespace bench {
namespace {

using macrotask::TraceAction;
using macrotask::TraceRecord;

std::string Json(const std::string& text) {
  return nlohmann::json(text).dump();
}

// Writes line by line: a document in memory would take a kilobyte a record.
class PerfettoWriter {
 public:
  explicit PerfettoWriter(const TraceHistory& history) : history_(history) {}

  void AddNames();
  void AddSpan(std::uint32_t task, const std::string& name, std::uint64_t begin,
               std::uint64_t end, const std::string& arguments = "{}");
  void AddInstant(const TraceRecord& record);
  void AddArrow(const EventWake& wake);

  std::string Document() const {
    return "{\"displayTimeUnit\":\"ns\",\"traceEvents\":[" + events_ + "\n]}\n";
  }

 private:
  // Whole nanoseconds, so that rounding keeps spans inside each other. Not
  // before recording: a clock may have been read a moment earlier.
  double Ns(std::uint64_t clock) const {
    return std::max(0.0, std::round(history_.trace.Seconds(clock) * 1e9));
  }
  static std::string Us(double ns) { return fmt::format("{:.3f}", ns / 1e3); }

  template <typename... Args>
  void Add(fmt::format_string<Args...> format, Args&&... args) {
    events_ += events_.empty() ? "\n" : ",\n";
    fmt::format_to(std::back_inserter(events_), format,
                   std::forward<Args>(args)...);
  }

  const TraceHistory& history_;
  std::string events_;
  int num_arrows_ = 0;
};

void PerfettoWriter::AddNames() {
  Add(R"({{"ph":"M","pid":1,"name":"process_name","args":{{"name":{}}}}})",
      Json("macrotask"));
  std::set<std::uint32_t> tasks;
  for (const TaskSpan& span : history_.spans) tasks.insert(span.task);
  for (const std::uint32_t task : tasks) {
    Add(R"({{"ph":"M","pid":1,"tid":{},"name":"thread_name",)"
        R"("args":{{"name":{}}}}})",
        task, Json(TaskText(history_, task)));
    Add(R"({{"ph":"M","pid":1,"tid":{0},"name":"thread_sort_index",)"
        R"("args":{{"sort_index":{0}}}}})",
        task);
  }
}

void PerfettoWriter::AddSpan(std::uint32_t task, const std::string& name,
                             std::uint64_t begin, std::uint64_t end,
                             const std::string& arguments) {
  const double ns = Ns(begin);
  Add(R"({{"ph":"X","pid":1,"tid":{},"ts":{},"dur":{},"name":{},"args":{}}})",
      task, Us(ns), Us(std::max(0.0, Ns(end) - ns)), Json(name), arguments);
}

void PerfettoWriter::AddInstant(const TraceRecord& record) {
  std::string name = ActionText(record.action);
  const std::string object = ObjectText(ObjectOf(record));
  if (!object.empty()) name += " " + object;
  Add(R"({{"ph":"i","s":"t","pid":1,"tid":{},"ts":{},"name":{},)"
      R"("args":{{"cpu":{},"detail":{}}}}})",
      record.task, Us(Ns(record.clock)), Json(name), record.cpu,
      Json(DetailText(record)));
}

// The arrow ends in the last nanosecond of the wait, as the end itself is
// outside of its span.
void PerfettoWriter::AddArrow(const EventWake& wake) {
  const double post = Ns(wake.post.clock);
  const double end = std::max(post, Ns(wake.wait.end) - 1);
  const int id = ++num_arrows_;
  const std::string name = Json(ObjectText(wake.wait.object));
  Add(R"({{"ph":"s","pid":1,"tid":{},"ts":{},"id":{},"cat":"EVPOST",)"
      R"("name":{}}})",
      wake.post.task, Us(post), id, name);
  Add(R"({{"ph":"f","bp":"e","pid":1,"tid":{},"ts":{},"id":{},)"
      R"("cat":"EVPOST","name":{}}})",
      wake.wait.task, Us(end), id, name);
}

bool IsInstant(const TraceRecord& record) {
  switch (record.action) {
    case TraceAction::kTaskBegin:
    case TraceAction::kTaskEnd:
    case TraceAction::kSleep:
    case TraceAction::kWake:
      return false;
    default:
      break;
  }
  const bool begins = macrotask::EndOf(record.action) != TraceAction::kNone;
  const bool ends = CallsOf(record) == 0;
  return !begins && !ends;
}

std::string SpanName(const TraceWait& wait) {
  if (wait.object.kind == macrotask::ObjectKind::kNone)
    return ActionText(wait.action);
  return ActionText(wait.action) + " " + ObjectText(wait.object);
}

}  // namespace

std::string PerfettoJson(const TraceHistory& history) {
  PerfettoWriter writer(history);
  writer.AddNames();
  for (const TaskSpan& span : history.spans) {
    writer.AddSpan(span.task, TaskText(history, span.task), span.begin,
                   span.end);
  }
  for (const TraceWait& wait : history.waits) {
    writer.AddSpan(wait.task, SpanName(wait), wait.begin, wait.end,
                   wait.finished ? "{}" : R"({"ended":false})");
  }
  for (const TraceRecord& record : history.records) {
    if (IsInstant(record)) writer.AddInstant(record);
  }
  for (const EventWake& wake : FindWakes(history)) writer.AddArrow(wake);
  return writer.Document();
}

}  // namespace bench
