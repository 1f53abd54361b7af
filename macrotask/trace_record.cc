#include "macrotask/trace_record.h"

namespace macrotask {
namespace {

struct ActionRow {
  TraceAction action;
  TraceClass trace_class;
  std::string_view name;
  TraceAction end = TraceAction::kNone;  // of the wait that it begins
};

using enum TraceAction;
using enum TraceClass;

constexpr ActionRow kActions[] = {
    {kTaskStart, kTasks, "TSKSTART"},
    {kTaskBegin, kTasks, "task begins"},
    {kTaskEnd, kTasks, "task ends"},
    {kTaskWait, kTasks, "TSKWAIT", kTaskWaitEnd},
    {kTaskWaitEnd, kTasks, "TSKWAIT end"},
    {kTaskTest, kTasks, "TSKTEST"},
    {kLockAssign, kLocks, "LOCKASGN"},
    {kLockOn, kLocks, "LOCKON", kLockOnEnd},
    {kLockOnEnd, kLocks, "LOCKON end"},
    {kLockOff, kLocks, "LOCKOFF"},
    {kLockTestOn, kLocks, "LOCKTEST clear"},
    {kLockTestSet, kLocks, "LOCKTEST set"},
    {kLockRelease, kLocks, "LOCKREL"},
    {kEventAssign, kEvents, "EVASGN"},
    {kEventPost, kEvents, "EVPOST"},
    {kEventWait, kEvents, "EVWAIT", kEventWaitEnd},
    {kEventWaitEnd, kEvents, "EVWAIT end"},
    {kEventClear, kEvents, "EVCLEAR"},
    {kEventTest, kEvents, "EVTEST posted"},
    {kEventTestClear, kEvents, "EVTEST clear"},
    {kEventRelease, kEvents, "EVREL"},
    {kBarrierAssign, kEvents, "BARASGN"},
    {kBarrierSync, kEvents, "BARSYNC", kBarrierSyncEnd},
    {kBarrierSyncEnd, kEvents, "BARSYNC end"},
    {kBarrierRelease, kEvents, "BARREL"},
    {kSleep, kCpus, "sleeps"},
    {kWake, kCpus, "wakes"},
    {kTraceClasses, kInfo, "BUFTUNE"},
    {kTune, kInfo, "TSKTUNE"},
};

constexpr ActionRow kUnknown = {kNone, kInfo, ""};

constexpr ActionRow kUser = {kNone, kUsers, ""};

const ActionRow& RowOf(TraceAction action) {
  for (const ActionRow& row : kActions) {
    if (row.action == action) return row;
  }
  const int number = static_cast<int>(action);
  const bool user = number >= kFirstUserAction && number <= kLastUserAction;
  return user ? kUser : kUnknown;
}

struct ClassRow {
  TraceClass trace_class;
  std::string_view name;
};

constexpr ClassRow kClasses[] = {
    {kTasks, "TASKS"}, {kLocks, "LOCKS"}, {kEvents, "EVENTS"},
    {kCpus, "CPUS"},   {kUsers, "USERS"}, {kInfo, "INFO"},
};

}  // namespace

std::string_view Name(TraceAction action) { return RowOf(action).name; }

std::string_view Name(TraceClass trace_class) {
  for (const ClassRow& row : kClasses) {
    if (row.trace_class == trace_class) return row.name;
  }
  return "";
}

std::optional<TraceAction> ParseTraceAction(std::string_view name) {
  for (const ActionRow& row : kActions) {
    if (row.name == name) return row.action;
  }
  return std::nullopt;
}

std::optional<TraceClass> ParseTraceClass(std::string_view name) {
  for (const ClassRow& row : kClasses) {
    if (row.name == name) return row.trace_class;
  }
  return std::nullopt;
}

TraceClass ClassOf(TraceAction action) { return RowOf(action).trace_class; }

TraceAction EndOf(TraceAction action) { return RowOf(action).end; }

}  // namespace macrotask
