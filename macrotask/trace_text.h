#pragma once

#include <compare>
#include <cstdint>
#include <string>
#include <vector>

#include "macrotask/trace_file.h"
#include "macrotask/waited_object.h"

// How a trace is read aloud, as free functions.

namespace macrotask {

// What a record is about. Numbers are counted per kind.
struct TraceObject {
  ObjectKind kind = ObjectKind::kNone;
  std::uint32_t number = 0;

  friend auto operator<=>(const TraceObject&, const TraceObject&) = default;
};

TraceObject ObjectOf(const TraceRecord& record);

// "barrier 3"; "" for kNone.
std::string ObjectText(const TraceObject& object);

// "BARSYNC", or "user 70" for the program's own actions, "action 99" if nobody
// knows it.
std::string ActionText(TraceAction action);

// A user value: its characters if it has eight and all are printable ASCII,
// without blanks at the end; "" for 0; else hexadecimal.
std::string ValueText(std::uint64_t value);

// What the data word says besides the object: "4 tasks", "HOLDTIME = 50".
std::string DetailText(const TraceRecord& record);

// How many calls the record stands for: 0 for the end of a wait, more than 1
// for tests in a row.
std::uint64_t CallsOf(const TraceRecord& record);

// The records of all buffers by clock; those of one buffer keep their order.
std::vector<TraceRecord> InOrderOfTime(const Trace& trace);

// A line an entry, in the order of time: microseconds since recording was
// switched on, task, processor, class, action, object and detail.
//
// Cray name: BUFPRINT.
std::string ToText(const Trace& trace);

}  // namespace macrotask
