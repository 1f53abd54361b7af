#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "integrators/task_structure.h"
#include "macrotask/trace_file.h"

// Where the time of a run went, from its history trace: computing, waiting for
// those who were not there yet, and what the waiting itself cost.

namespace bench {

// Where the tasks of a run wait.
enum class Construct { kAllTasks, kChains, kPoints, kEvent };
inline constexpr int kNumConstructs = 4;

// "BARSYNC(all)", "BARSYNC(m^)", "BARSYNC(p^)", "EVWAIT".
const char* Name(Construct construct);

// Where the tasks of a figure wait: its barriers in the order in which each of
// them first comes there, and the event. The first one is the run's own.
// None of those at which only one task calls.
std::vector<Construct> ConstructsOf(integrators::Figure figure,
                                    integrators::Partition partition);

// In ticks.
struct Waiting {
  std::uint64_t imbalance = 0;  // from the arrival to that of the last task, or
                                // to the post; none if that was before
  std::uint64_t sync = 0;       // from then until the task goes on

  friend bool operator==(const Waiting&, const Waiting&) = default;
};

struct TaskBreakdown {
  std::uint64_t compute = 0;  // ticks
  std::array<Waiting, kNumConstructs> waiting;

  // From the beginning of the run to the end of the task's part of it.
  std::uint64_t total() const;

  friend bool operator==(const TaskBreakdown&, const TaskBreakdown&) = default;
};

// The records by which task `task`, from 0, says that its part of a run begins,
// and ends.
void RecordBegin(int task);
void RecordEnd(int task);

// What the tasks recorded in the last run that a trace shows, by task, each
// from its RecordBegin() to its RecordEnd(). Throws std::runtime_error, one
// sentence, if a task's are not all there.
using RunRecords = std::vector<std::vector<macrotask::TraceRecord>>;
RunRecords RecordsOfLastRun(const macrotask::Trace& trace, int num_tasks);

// Divides the time of the run, which is that of the first task, for every task.
// One that begins later is still in the barrier that let them all go; what it
// did before does not count, nor what it does after the first task has ended.
//
// Each task comes to a barrier once a phase, and waits for an event once a
// post: so the k-th waits of all tasks at an object belong together, and no
// clock is needed to find them. Where the clocks of two processors differ,
// imbalance and sync exchange time, but the columns of a task still add up to
// its total. A barrier of one task holds nobody and counts as compute.
// Requires: `constructs` of the figure, as ConstructsOf() says.
std::vector<TaskBreakdown> BreakDown(const RunRecords& run,
                                     const std::vector<Construct>& constructs);

}  // namespace bench
