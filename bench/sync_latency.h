#pragma once

#include <optional>
#include <vector>

#include "bench/sync_marks.h"

namespace bench {

// From where to where a latency goes.
enum class LatencyKind {
  kNone,
  kLastInLastOut,  // barrier: last arrival to last departure
  kFromFirstTask,  // task 0 posts, wakes, starts: first and last of the others
  kHandOff,        // lock: release to return of the next one's request
};

// Seconds, one entry per call (hand-off).
struct Latencies {
  std::vector<double> first;  // of several who are let go; else empty
  std::vector<double> last;
};

// Of the calls that all tasks have completed.
Latencies CalcLatencies(LatencyKind kind, const std::vector<TaskMarks>& tasks);

// Acquisitions in the order in which the lock was got, of which only those
// count that another task released while the next one was already waiting.
std::vector<double> CalcHandOffs(const std::vector<TaskMarks>& tasks);

// Seconds from `in` to `release` of the first task, call by call: a construct
// too rare for a loop, timed as a whole.
std::vector<double> CalcWholes(const std::vector<TaskMarks>& tasks);

}  // namespace bench
