#include "macrotask/trace_text.h"

#include <algorithm>
#include <cinttypes>
#include <cstdio>
#include <iterator>

namespace macrotask {
namespace {

using enum TraceAction;

std::string Hex(std::uint64_t value) {
  char text[24];
  std::snprintf(text, sizeof text, "0x%" PRIx64, value);
  return text;
}

bool IsUserAction(TraceAction action) {
  return ClassOf(action) == TraceClass::kUsers;
}

ObjectKind KindOf(TraceAction action) {
  switch (action) {
    case kTaskStart:
    case kTaskWait:
    case kTaskWaitEnd:
    case kTaskTest:
      return ObjectKind::kTask;
    case kBarrierAssign:
    case kBarrierSync:
    case kBarrierSyncEnd:
    case kBarrierRelease:
      return ObjectKind::kBarrier;
    default:
      break;
  }
  switch (ClassOf(action)) {
    case TraceClass::kLocks:
      return ObjectKind::kLock;
    case TraceClass::kEvents:
      return ObjectKind::kEvent;
    default:
      return ObjectKind::kNone;
  }
}

std::string ClassesText(std::uint64_t bits) {
  std::string text;
  for (std::uint32_t bit = 1; bit < kAllTraceClasses; bit *= 2) {
    if ((bits & bit) == 0) continue;
    text += text.empty() ? "" : " ";
    text += Name(static_cast<TraceClass>(bit));
  }
  return text.empty() ? "nothing" : text;
}

std::string TuneText(const TraceRecord& record) {
  constexpr const char* kNames[] = {"MAXCPU",   "DBRELEAS", "DBACTIVE",
                                    "HOLDTIME", "SAMPLE",   "STACKSZ"};
  const std::uint32_t which = record.detail();
  const std::string name = which >= 1 && which <= std::size(kNames)
                               ? kNames[which - 1]
                               : "value " + std::to_string(which);
  return name + " = " + std::to_string(record.object());
}

}  // namespace

TraceObject ObjectOf(const TraceRecord& record) {
  const ObjectKind kind = KindOf(record.action);
  if (kind == ObjectKind::kNone) return {};
  return {kind, record.object()};
}

std::string ObjectText(const TraceObject& object) {
  if (object.kind == ObjectKind::kNone) return "";
  return std::string(Name(object.kind)) + " " + std::to_string(object.number);
}

std::string ActionText(TraceAction action) {
  const auto name = Name(action);
  if (!name.empty()) return std::string(name);
  return (IsUserAction(action) ? "user " : "action ") +
         std::to_string(static_cast<int>(action));
}

std::string ValueText(std::uint64_t value) {
  if (value == 0) return "";
  std::string text;
  for (int shift = 0; shift < 64; shift += 8) {
    text += static_cast<char>(value >> shift & 0xff);
  }
  const bool printable = std::all_of(
      text.begin(), text.end(), [](char c) { return c >= ' ' && c <= '~'; });
  if (!printable) return Hex(value);
  return text.substr(0, text.find_last_not_of(' ') + 1);
}

std::string DetailText(const TraceRecord& record) {
  switch (record.action) {
    case kTaskBegin:
      return ValueText(record.data);
    case kTaskTest:
      return record.detail() == 0 ? "complete" : "not complete";
    case kLockTestSet:
    case kEventTest:
    case kEventTestClear:
      return CallsOf(record) == 1 ? ""
                                  : std::to_string(CallsOf(record)) + " times";
    case kBarrierAssign:
    case kBarrierSync:
      return std::to_string(record.detail()) +
             (record.detail() == 1 ? " task" : " tasks");
    case kTraceClasses:
      return ClassesText(record.data);
    case kTune:
      return TuneText(record);
    default:
      break;
  }
  if (ObjectOf(record).kind != ObjectKind::kNone || record.data == 0) return "";
  return IsUserAction(record.action) ? ValueText(record.data)
                                     : Hex(record.data);
}

std::uint64_t CallsOf(const TraceRecord& record) {
  switch (record.action) {
    case kTaskWaitEnd:
    case kLockOnEnd:
    case kEventWaitEnd:
    case kBarrierSyncEnd:
      return 0;
    case kLockTestSet:
    case kEventTest:
    case kEventTestClear:
      return std::max<std::uint32_t>(record.detail(), 1);
    default:
      return 1;
  }
}

std::vector<TraceRecord> InOrderOfTime(const Trace& trace) {
  std::vector<TraceRecord> records;
  for (const TraceBuffer& buffer : trace.buffers) {
    records.insert(records.end(), buffer.records.begin(), buffer.records.end());
  }
  std::stable_sort(records.begin(), records.end(),
                   [](const TraceRecord& a, const TraceRecord& b) {
                     return a.clock < b.clock;
                   });
  return records;
}

std::string ToText(const Trace& trace) {
  std::string text =
      "      time (us)  task  cpu  class   action          data\n";
  for (const TraceRecord& record : InOrderOfTime(trace)) {
    char line[96];
    std::snprintf(line, sizeof line, "%15.3f %5" PRIu32 " %4d  %-6s  %-15s ",
                  trace.Seconds(record.clock) * 1e6, record.task, record.cpu,
                  std::string(Name(ClassOf(record.action))).c_str(),
                  ActionText(record.action).c_str());
    const std::string object = ObjectText(ObjectOf(record));
    const std::string detail = DetailText(record);
    text += line + object + (object.empty() || detail.empty() ? "" : ", ") +
            detail + "\n";
  }
  return text;
}

}  // namespace macrotask
