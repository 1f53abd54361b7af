#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bench/trace_history.h"

// Who ran when, and where.

namespace bench {

// A task runs: it is between its beginning and its end, and does not wait.
// Where it is between two records is not known; it counts as where the first
// was.
struct RunningPiece {
  std::uint32_t task;
  std::uint16_t cpu;
  std::uint64_t begin;
  std::uint64_t end;

  friend bool operator==(const RunningPiece&, const RunningPiece&) = default;
};

// By task, then in time; none is empty.
std::vector<RunningPiece> RunningPieces(const TraceHistory& history);

// [n]: ticks from `begin` to `end` during which n of the pieces ran. At least
// one element.
std::vector<std::uint64_t> TicksAtConcurrency(
    const std::vector<RunningPiece>& pieces, std::uint64_t begin,
    std::uint64_t end);

// How many ran on average; 0 without time.
double MeanConcurrency(const std::vector<std::uint64_t>& ticks);

enum class TaskState {
  kReady,
  kRunning,
  kSleeping,
  kWaiting,
  kComplete,
  kLost
};

// A task at the end of the trace.
struct TaskStatus {
  std::uint32_t task;
  TaskState state;
  macrotask::TraceObject object;  // what it waits for
  bool sleeps;                    // while it waits
  std::uint64_t since;            // clock
};

// All tasks of the trace, also those that others have started and that have
// left no record: kReady, or kLost where their records may have been lost.
std::vector<TaskStatus> StatesAtEnd(const TraceHistory& history);

// "waiting for barrier 3, asleep"
std::string StateText(const TaskStatus& status);

}  // namespace bench
