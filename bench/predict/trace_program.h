#pragma once

#include <string_view>

#include "bench/predict/program.h"
#include "bench/trace_history.h"

namespace bench::predict {

// A program of anybody's, out of its history trace: what each task called, and
// how long it computed between two calls (see StepReader).
//
// Tasks are in the order of their numbers, and end with their last record. One
// that another task of the trace started begins with its kStart. All others,
// such as the initial task, begin with a kCompute of kOther from the first
// record of the trace to their own first one, unless that is 0. A number of
// which there is nothing but sleeps is no task, but a pthread that waits for
// one.
//
// The wait of a Task's destructor leaves no record, so that there is no kJoin
// and it looks like computing, except while it sleeps.
//
// Throws std::runtime_error, one sentence that begins with `name` and says what
// was expected, if the trace was recorded without one of the classes TASKS,
// LOCKS and EVENTS, at any time that INFO records tell of or at the end, or,
// as INFO records tell, as a lean one; has lost records, has none, shows a task
// that is started twice, or a barrier of different numbers of tasks.
Program ProgramOf(const TraceHistory& history, std::string_view name,
                  double record_seconds);

}  // namespace bench::predict
