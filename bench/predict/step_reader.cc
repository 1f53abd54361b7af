#include "bench/predict/step_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <span>
#include <stdexcept>
#include <utility>

#include "bench/predict/marks.h"

namespace bench::predict {
namespace {

using macrotask::ObjectKind;
using macrotask::TraceAction;
using macrotask::TraceObject;
using macrotask::TraceRecord;
using enum macrotask::TraceAction;
using enum StepKind;

std::span<const TraceRecord> UntilTaskEnd(
    const std::vector<TraceRecord>& records) {
  const auto end = std::find_if(
      records.begin(), records.end(),
      [](const TraceRecord& record) { return record.action == kTaskEnd; });
  return {records.begin(), end == records.end() ? end : end + 1};
}

bool IsWait(TraceAction action) { return EndOf(action) != kNone; }

bool IsTestInVain(TraceAction action) {
  return action == kLockTestSet || action == kEventTestClear;
}

// The last record of a call that can have several.
TraceAction LastOf(TraceAction action) {
  switch (action) {
    case kLockTestSet:
      return kLockTestOn;
    case kEventTestClear:
      return kEventTest;
    case kEventAssign:
      return kEventClear;
    default:
      return EndOf(action);
  }
}

// Whether the call that begins with `first` may go on after `record`.
bool GoesOn(const TraceRecord& first, const TraceRecord& record) {
  if (IsWait(first.action)) {
    return record.action == kSleep || record.action == kWake;
  }
  return IsTestInVain(first.action) && record.action == first.action &&
         record.object() == first.object();
}

// Index of the last record of the call that begins at `first`: that one, unless
// the others are there, or it waits until the end of the records.
std::size_t LastOfCall(std::span<const TraceRecord> records,
                       std::size_t first) {
  const TraceRecord& begin = records[first];
  std::size_t last = first + 1;
  while (last < records.size() && GoesOn(begin, records[last])) ++last;
  if (last == records.size()) return IsWait(begin.action) ? last - 1 : first;
  const bool is_there = records[last].action == LastOf(begin.action) &&
                        ObjectOf(records[last]) == ObjectOf(begin);
  return is_there ? last : first;
}

// Whether the record is of a call on its object, or assigns it.
bool Meets(const TraceRecord& record) {
  const bool releases = record.action == kLockRelease ||
                        record.action == kEventRelease ||
                        record.action == kBarrierRelease;
  return ObjectOf(record).kind != ObjectKind::kNone && CallsOf(record) > 0 &&
         !releases;
}

std::optional<StepKind> KindOf(TraceAction action) {
  switch (action) {
    case kBarrierSync:
      return kBarrier;
    case kEventPost:
      return kPost;
    case kEventWait:
    case kEventTest:
      return kWait;
    case kEventAssign:
    case kEventClear:
      return kClear;
    case kLockOn:
    case kLockTestOn:
      return kLock;
    case kLockOff:
      return kUnlock;
    case kTaskStart:
      return kStart;
    case kTaskWait:
      return kJoin;
    default:
      return {};
  }
}

}  // namespace

StepReader::StepReader(double ticks_per_second, double record_seconds,
                       std::map<std::uint32_t, int> task_index)
    : ticks_per_second_(ticks_per_second),
      record_seconds_(record_seconds),
      task_index_(std::move(task_index)) {}

std::vector<Step> StepReader::Read(
    const std::vector<TraceRecord>& all_records) {
  const std::span<const TraceRecord> records = UntilTaskEnd(all_records);
  std::vector<Step> steps;
  std::size_t last = 0;
  for (std::size_t first = 0; first < records.size(); first = last + 1) {
    last = LastOfCall(records, first);
    // Which step tests are is known by the last one, which may succeed.
    const bool tests = IsTestInVain(records[first].action);
    AddCall(records[tests ? last : first], &steps);
    // A sleep outside of a wait, or a wait whose end is lost.
    const TraceAction action = records[last].action;
    const bool waits = IsWait(action) || action == kSleep;
    if (waits || last + 1 == records.size()) continue;
    steps.push_back(Computing(records[last], records[last + 1]));
  }
  return steps;
}

Step StepReader::Computing(const TraceRecord& from,
                           const TraceRecord& to) const {
  const double seconds =
      static_cast<double>(to.clock - from.clock) / ticks_per_second_;
  return Compute(MarkOf(from).value_or(Block::kOther),
                 std::max(seconds - record_seconds_, 0.0));
}

void StepReader::AddCall(const TraceRecord& call, std::vector<Step>* steps) {
  if (!Meets(call)) return;
  const TraceObject object = ObjectOf(call);
  const bool only_assigns =
      call.action == kEventAssign &&
      !indices_.at(ObjectKind::kEvent).contains(object.number);
  const std::optional<int> index = IndexOf(object);
  if (call.action == kBarrierAssign || call.action == kBarrierSync) {
    barriers_[object.number].insert(call.detail());
  }
  const std::optional<StepKind> kind = KindOf(call.action);
  if (!kind || !index || only_assigns) return;
  steps->push_back(Sync(*kind, *index));
}

std::optional<int> StepReader::IndexOf(const TraceObject& object) {
  if (object.kind == ObjectKind::kTask) {
    const auto task = task_index_.find(object.number);
    return task == task_index_.end() ? std::nullopt
                                     : std::optional(task->second);
  }
  Indices& indices = indices_.at(object.kind);
  const int next = static_cast<int>(indices.size());
  return indices.try_emplace(object.number, next).first->second;
}

void StepReader::TakeObjects(Program* program) const {
  const auto count = [&](ObjectKind kind) {
    return static_cast<int>(indices_.at(kind).size());
  };
  program->num_events = count(ObjectKind::kEvent);
  program->num_locks = count(ObjectKind::kLock);
  program->barriers.assign(barriers_.size(), 0);
  for (const auto& [number, index] : indices_.at(ObjectKind::kBarrier)) {
    const std::set<std::uint32_t>& num_tasks = barriers_.at(number);
    if (num_tasks.size() > 1) {
      throw std::runtime_error(fmt::format(
          "barrier {} is of {} tasks and of {}: expected one number of tasks",
          number, *num_tasks.begin(), *num_tasks.rbegin()));
    }
    program->barriers[static_cast<std::size_t>(index)] =
        static_cast<int>(*num_tasks.begin());
  }
}

}  // namespace bench::predict
