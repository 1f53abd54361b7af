#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace macrotask {

// What the history trace can record, each switched for itself. Barriers are
// events here: the list of classes is older than they are.
enum class TraceClass : std::uint32_t {
  kTasks = 1,   // starts, ends and waits of tasks
  kLocks = 2,   // every call on a lock
  kEvents = 4,  // every call on an event or a barrier
  kCpus = 8,    // a task gives its processor up, or has it back
  kUsers = 16,  // what the program itself records
  kInfo = 32,   // about the trace and the tuning of the library
};
inline constexpr std::uint32_t kAllTraceClasses = 63;

// What has happened. The numbers are part of the file format: never change one.
// A wait is two records, ...Wait and ...WaitEnd, of the same object by the same
// task; a call that need not wait leaves both as well.
//
// The data word of a record is the number of an object in its low half, and in
// its high half what is said here; 0 where nothing is.
enum class TraceAction : std::uint16_t {
  kNone = 0,
  // TASKS. Object: the number of the other task.
  kTaskStart = 1,    // this task starts the other
  kTaskBegin = 2,    // this task's body begins. Data: its user value, 64 bits
  kTaskEnd = 3,      // this task's body has ended
  kTaskWait = 4,     // for the other to complete
  kTaskWaitEnd = 5,  //
  kTaskTest = 6,     // High half: 1 if the other is not complete
  // LOCKS. Object: the number of the lock.
  kLockAssign = 10,   //
  kLockOn = 11,       // asks for the lock
  kLockOnEnd = 12,    // holds it
  kLockOff = 13,      //
  kLockTestOn = 14,   // LOCKTEST that found it clear: holds it
  kLockTestSet = 15,  // LOCKTEST that found it set. High half: how many in a
                      // row, nothing else between; clock: of the first
  kLockRelease = 16,  //
  // EVENTS. Object: the number of the event or barrier.
  kEventAssign = 20,     //
  kEventPost = 21,       //
  kEventWait = 22,       //
  kEventWaitEnd = 23,    //
  kEventClear = 24,      //
  kEventTest = 25,       // that found it posted. High half: as in
                         // kLockTestSet
  kEventTestClear = 26,  // that found it cleared. High half: likewise
  kEventRelease = 27,    //
  kBarrierAssign = 30,   // High half: number of tasks
  kBarrierSync = 31,     // arrives. High half: number of tasks
  kBarrierSyncEnd = 32,  // leaves
  kBarrierRelease = 33,  //
  // CPUS. Object: 0.
  kSleep = 40,  // gives up the processor to wait in the kernel
  kWake = 41,   // has one again
  // INFO
  kTraceClasses = 50,  // recording begins or changes. Data: TraceClass bits
  kTune = 51,          // a tuning value was set. Object: the value. High half:
                       // which, from 1: MAXCPU, DBRELEAS, DBACTIVE, HOLDTIME,
                       // SAMPLE, STACKSZ
  // USERS: actions 65 to 128 are the program's. Data: the program's, 64 bits.
};

inline constexpr int kFirstUserAction = 65;
inline constexpr int kLastUserAction = 128;

// One entry of the history trace.
struct TraceRecord {
  std::uint64_t clock;  // ticks, see Trace::ticks_per_second
  std::uint64_t data;   // see TraceAction
  std::uint32_t task;   // number of the task that did it; 1: the initial task
  std::uint16_t cpu;    // the system's number of its processor
  TraceAction action;

  std::uint32_t object() const { return static_cast<std::uint32_t>(data); }
  std::uint32_t detail() const {
    return static_cast<std::uint32_t>(data >> 32);
  }

  friend bool operator==(const TraceRecord&, const TraceRecord&) = default;
};
static_assert(sizeof(TraceRecord) == 24);

// Cray's name where there is one: "BARSYNC", "BARSYNC end", "task begins",
// "sleeps"; "user 70" has none: "" for the program's own actions and unknown
// ones.
std::string_view Name(TraceAction action);
std::string_view Name(TraceClass trace_class);  // "TASKS", "LOCKS", ...
std::optional<TraceAction> ParseTraceAction(std::string_view name);
std::optional<TraceClass> ParseTraceClass(std::string_view name);
TraceClass ClassOf(TraceAction action);

// What ends the wait that `action` begins: kBarrierSyncEnd for kBarrierSync;
// kNone if it begins none.
TraceAction EndOf(TraceAction action);

}  // namespace macrotask
