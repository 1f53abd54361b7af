#pragma once

#include <string>

#include "bench/trace_history.h"

namespace bench {

// The trace in Chrome's trace event format (JSON), which ui.perfetto.dev and
// chrome://tracing open: a row for each task, its body and its waits as spans,
// all else as instants, and an arrow from every EVPOST to the EVWAIT it ended.
// Times are microseconds since recording was switched on.
std::string PerfettoJson(const TraceHistory& history);

}  // namespace bench
