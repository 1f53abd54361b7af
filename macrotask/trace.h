#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "macrotask/trace_file.h"
#include "macrotask/trace_record.h"

namespace macrotask {

// The history trace: what every task called and when, for a look afterwards.
//
// Every pthread that runs tasks writes into a ring of its own, without any
// synchronization; when it is full, the oldest records are overwritten and
// counted.
//
// Cray name: BUFTUNE (SetTraceClasses, SetTraceFile), BUFUSER (RecordUser),
// BUFDUMP (TakeTrace, WriteTrace).
// Use: any task, at any time; TakeTrace() may run beside tasks that record.
// Cost: recording off, one load and one predictable branch a call; on, two
// clock readings and 48 bytes a wait (bench rows "BARSYNC" and "BARSYNC,
// traced").
//
//   SetTraceClasses(kAllTraceClasses);
//   RunTasks(num_tasks, body);
//   WriteTrace(TakeTrace(), "run.trace");

// Records these TraceClass bits from now on; 0 switches recording off. The
// clock of the trace begins with the first call that switches anything on.
// With kLeanTrace beside the classes: only what tells how long each wait was,
// at half the cost. EVCLEAR, EVTEST, LOCKTEST in vain and the calls of a
// barrier of one task are left out, and a clock may be read some ten
// nanoseconds before what it is written beside, so that the records of two
// tasks are in order only if they are farther apart.
inline constexpr std::uint32_t kLeanTrace = std::uint32_t{1} << 31;
void SetTraceClasses(std::uint32_t classes);
std::uint32_t TraceClasses();

// Number of records that the ring of a pthread holds, for pthreads that have
// not recorded anything yet. Rounded up to a power of two. Throws
// std::invalid_argument unless 2 <= `num_records` <= 2^28.
inline constexpr std::size_t kDefaultTraceSize = std::size_t{1} << 15;
void SetTraceSize(std::size_t num_records);

// An entry of the program's own. Throws std::invalid_argument unless
// kFirstUserAction <= `action` <= kLastUserAction.
void RecordUser(std::int64_t action, std::uint64_t data);

// All that the rings hold now.
Trace TakeTrace();

// Names the file which the trace is written to at the normal end of the
// program, and when a deadlock or a bad call ends it; "" for none. Also set,
// with all classes on, by the environment variable MACROTASK_TRACE.
void SetTraceFile(const std::string& path);
std::string TraceFile();

}  // namespace macrotask
