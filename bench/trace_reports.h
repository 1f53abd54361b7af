#pragma once

#include <string>

#include "bench/trace_filter.h"
#include "bench/trace_history.h"

// What `macrotask trace` prints, after Cray's MTDUMP.

namespace bench {

enum class TraceReport { kTotals, kChron, kSync, kCpu, kStatus };
const char* Name(TraceReport report);  // as on the command line

// Where and when, how many records, how many were lost.
std::string TraceHeader(const TraceHistory& history);

// The filter's tasks restrict all reports; its classes and actions CHRON, the
// counts by action of TOTALS, and the objects, calls and waits of SYNC. What
// must see all tasks does: who came last at a barrier, who posted, who waited
// for the holder of a lock.
std::string TraceReportText(TraceReport report, const TraceHistory& history,
                            const TraceFilter& filter);

// The single reports, each a text that ends with a newline.
std::string ChronText(const TraceHistory& history, const TraceFilter& filter);
std::string TotalsText(const TraceHistory& history, const TraceFilter& filter);
std::string SyncText(const TraceHistory& history, const TraceFilter& filter);
std::string CpuText(const TraceHistory& history, const TraceFilter& filter);
std::string StatusText(const TraceHistory& history, const TraceFilter& filter);

// CHRON as CSV, with the data word as a number in addition.
std::string ChronCsv(const TraceHistory& history, const TraceFilter& filter);

// A time in microseconds, to the nanosecond.
std::string UsText(double us);

}  // namespace bench
