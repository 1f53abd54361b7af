#pragma once

#include <string>
#include <vector>

namespace macrotask {

// Seconds during which 0, 1, ..., NumProcessors() processors were busy with
// tasks of this process since its start: shape (NumProcessors() + 1).
//
// The initial task and every pthread of this library keep a processor busy,
// except while they sleep in a wait of this library: one that spins, for a task
// to go on or for another task to be started on it, holds its processor. With
// more of them than processors all of these are busy.
//
// Cray name: MTTIMES.
// Use: any task, at any time.
std::vector<double> BusyTimes();

// The table that MTTIMES prints: processors, seconds, share; total and average
// concurrency.
std::string ToString(const std::vector<double>& busy_times);

// Internal: so many more (fewer) pthreads keep a processor busy from now on.
void NoteBusy(int change);

}  // namespace macrotask
