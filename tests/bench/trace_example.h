#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "bench/trace_history.h"
#include "macrotask/trace_file.h"

// Traces made by hand, for the tests of what reads them.

namespace bench {

using Action = macrotask::TraceAction;

// The data word of an object's number and what the high half says.
constexpr std::uint64_t Data(std::uint32_t object, std::uint32_t detail = 0) {
  return static_cast<std::uint64_t>(detail) << 32 | object;
}

// Eight characters as a user value.
constexpr std::uint64_t Value(const char (&text)[9]) {
  std::uint64_t value = 0;
  for (int i = 7; i >= 0; --i) {
    value = value << 8 | static_cast<unsigned char>(text[i]);
  }
  return value;
}

// What one task does on one processor.
class Script {
 public:
  explicit Script(std::uint32_t task, std::uint16_t cpu = 0)
      : task_(task), cpu_(cpu) {}

  Script& At(std::uint64_t clock, Action action, std::uint64_t data = 0) {
    records_.push_back({clock, data, task_, cpu_, action});
    return *this;
  }
  Script& Wait(std::uint64_t begin, std::uint64_t end, Action action,
               std::uint64_t data) {
    At(begin, action, data);
    return At(end, macrotask::EndOf(action),
              Data(static_cast<std::uint32_t>(data)));
  }
  Script& MoveTo(std::uint16_t cpu) {
    cpu_ = cpu;
    return *this;
  }

  macrotask::TraceBuffer Buffer(std::uint64_t num_lost = 0) const {
    return {task_, 0, num_lost, records_};
  }

 private:
  std::uint32_t task_;
  std::uint16_t cpu_;
  std::vector<macrotask::TraceRecord> records_;
};

// One tick is a microsecond; recording begins at 1000 and ends at `last`.
inline macrotask::Trace TraceOf(std::vector<macrotask::TraceBuffer> buffers,
                                std::uint64_t last = 1100) {
  macrotask::Trace trace;
  trace.ticks_per_second = 1e6;
  trace.first_clock = 1000;
  trace.last_clock = last;
  trace.first_unix_ns = 725'846'400'000'000'000;  // 1993-01-01
  trace.num_processors = 2;
  trace.classes = macrotask::kAllTraceClasses;
  trace.buffers = std::move(buffers);
  return trace;
}

inline TraceHistory HistoryOf(std::vector<macrotask::TraceBuffer> buffers,
                              std::uint64_t last = 1100) {
  return MakeHistory(TraceOf(std::move(buffers), last));
}

// Two tasks for 100 us: a barrier twice, an event, a lock, a user record.
// Task 1 runs 55 us of them, task 2 80 us.
inline macrotask::Trace ExampleTrace() {
  using enum macrotask::TraceAction;
  const auto user = static_cast<Action>(70);
  Script one(1, 0), two(2, 1);
  one.At(1000, kTraceClasses, 63)
      .At(1000, kBarrierAssign, Data(3, 2))
      .At(1005, kTaskStart, Data(2))
      .Wait(1020, 1030, kBarrierSync, Data(3, 2))
      .Wait(1050, 1051, kBarrierSync, Data(3, 2))
      .Wait(1055, 1065, kEventWait, Data(1))
      .At(1065, kEventClear, Data(1))
      .Wait(1070, 1079, kLockOn, Data(4))
      .At(1080, kLockOff, Data(4))
      .Wait(1085, 1100, kTaskWait, Data(2));
  two.At(1010, kTaskBegin, Value("ARM  \"1\""))
      .Wait(1029, 1030, kBarrierSync, Data(3, 2))
      .Wait(1045, 1051, kBarrierSync, Data(3, 2))
      .At(1060, kEventPost, Data(1))
      .Wait(1062, 1062, kLockOn, Data(4))
      .At(1078, kLockOff, Data(4))
      .At(1081, user, 5)
      .At(1097, kTaskEnd);
  macrotask::TraceBuffer second = two.Buffer();
  second.value = Value("ARM  \"1\"");
  return TraceOf({one.Buffer(), second});
}

}  // namespace bench
