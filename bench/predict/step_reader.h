#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <vector>

#include "bench/predict/program.h"
#include "macrotask/trace_file.h"
#include "macrotask/trace_text.h"

namespace bench::predict {

// Turns the records of tasks into steps.
//
// Every call is a step. Between two records that a task does not spend waiting
// it computes: a kCompute step of that length less `record_seconds`, what
// writing the record took, at least 0; it is there also when 0. Its block is
// that of the mark (marks.h) if the record before is one, else kOther. A wait
// (BARSYNC, EVWAIT, LOCKON, TSKWAIT) is one step, from its record to that of
// its end; one that has not ended at the end of the records is a step too.
// kSleep and kWake records inside a wait are part of it; a sleep outside of
// one, as of a Task's destructor, is neither a step nor computing. What comes
// after kTaskEnd is not the task's: its pthread waits for the next one.
//
// LOCKTEST or EVTEST in vain followed, with only further such tests of the same
// object in between, by one that succeeds is one kLock or kWait from the first
// test on; a test in vain that is not followed so is no step, its time
// computing, of which nobody knows how much was tests: the record of a row has
// the clock of the first one only. An EVTEST that succeeds at once is a kWait.
// A TSKTEST is no step. Assigning and releasing objects is no step, but an
// EVASGN of an event that was met before, by this task or one that was read
// before, is a kClear; the EVCLEAR that the library records right after an
// EVASGN is part of it.
class StepReader {
 public:
  // `task_index`: the index of the task with a number, for kStart and kJoin;
  // those of a task that is not in it are no step.
  StepReader(double ticks_per_second, double record_seconds,
             std::map<std::uint32_t, int> task_index);

  // The steps of one task, from its records in time order.
  std::vector<Step> Read(const std::vector<macrotask::TraceRecord>& records);

  // Puts the objects that all tasks so far have met into `program`: indices are
  // given in the order in which they were met. Throws std::runtime_error, one
  // sentence, if a barrier had different numbers of tasks.
  void TakeObjects(Program* program) const;

 private:
  using Indices = std::map<std::uint32_t, int>;  // by number

  Step Computing(const macrotask::TraceRecord& from,
                 const macrotask::TraceRecord& to) const;
  void AddCall(const macrotask::TraceRecord& call, std::vector<Step>* steps);
  std::optional<int> IndexOf(const macrotask::TraceObject& object);

  double ticks_per_second_;
  double record_seconds_;
  Indices task_index_;
  std::map<macrotask::ObjectKind, Indices> indices_ = {
      {macrotask::ObjectKind::kBarrier, {}},
      {macrotask::ObjectKind::kEvent, {}},
      {macrotask::ObjectKind::kLock, {}}};
  // By number of the barrier: how many tasks it was said to be of.
  std::map<std::uint32_t, std::set<std::uint32_t>> barriers_;
};

}  // namespace bench::predict
