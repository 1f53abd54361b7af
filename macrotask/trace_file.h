#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "macrotask/trace_record.h"

namespace macrotask {

// The records of one pthread, oldest first, hence of all tasks that ran on it
// one after the other.
struct TraceBuffer {
  std::uint32_t task = 0;      // the task that ran on it last
  std::uint64_t value = 0;     // that task's user value
  std::uint64_t num_lost = 0;  // older records that were overwritten
  std::vector<TraceRecord> records;

  friend bool operator==(const TraceBuffer&, const TraceBuffer&) = default;
};

// A history trace, as BUFDUMP writes it and `macrotask trace` reads it.
struct Trace {
  double ticks_per_second = 1e9;
  std::uint64_t first_clock = 0;   // recording was switched on
  std::uint64_t last_clock = 0;    // the trace was taken
  std::int64_t first_unix_ns = 0;  // the time of day at first_clock
  std::uint32_t num_processors = 0;
  std::uint32_t classes = 0;  // TraceClass bits that were recorded at the end
  std::vector<TraceBuffer> buffers;

  // Time since recording was switched on.
  double Seconds(std::uint64_t clock) const;

  friend bool operator==(const Trace&, const Trace&) = default;
};

// The file format, version 1. All numbers are little-endian, floating point
// numbers are IEEE 754; nothing is padded.
//
//   header, 72 bytes
//      0  char[8]  "MTHISTRY"
//      8  u32      version, 1
//     12  u32      size of a record, 24
//     16  u64      size of the whole file in bytes
//     24  f64      ticks per second
//     32  u64      clock when recording was switched on
//     40  u64      clock when the trace was taken
//     48  i64      time of day at the former, ns since 1970-01-01
//     56  u32      number of processors
//     60  u32      classes recorded, TraceClass bits
//     64  u32      number of buffers
//     68  u32      0
//   each buffer: header of 32 bytes, then its records
//      0  u32      number of the task that ran last
//      4  u32      0
//      8  u64      that task's user value
//     16  u64      number of older records that were overwritten
//     24  u64      number of records
//   each record, 24 bytes, oldest first
//      0  u64      clock, ticks
//      8  u64      data
//     16  u32      number of the task
//     20  u16      processor
//     22  u16      action, see TraceAction
std::string EncodeTrace(const Trace& trace);

// Throws std::runtime_error, one sentence that begins with `name`, if `bytes`
// are no trace, a truncated one, or one of another version.
Trace DecodeTrace(std::string_view bytes, std::string_view name);

// Writes the file, whole or not at all: beside `path` first, then renamed.
// Throws std::runtime_error, one sentence with the path and the reason.
void WriteTrace(const Trace& trace, const std::string& path);

// Throws as DecodeTrace(), also if the file cannot be read.
Trace ReadTrace(const std::string& path);

}  // namespace macrotask
