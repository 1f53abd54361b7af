#include <cstdarg>
#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

#define MACROTASK_NO_MACROS
#include "macrotask/cray.h"
#include "macrotask/cray/call.h"
#include "macrotask/cray/objects.h"
#include "macrotask/cray/printing.h"
#include "macrotask/cray/tasks.h"
#include "macrotask/cray/tuning.h"
#include "macrotask/task.h"
#include "macrotask/trace.h"

namespace macrotask::cray {

using Logical = int;

#define Word long
#define MACROTASK_NAME(UPPER, lower) UPPER
#include "macrotask/cray/c_calls-inl.h"
#undef Word
#undef MACROTASK_NAME

#define Word int
#define MACROTASK_NAME(UPPER, lower) UPPER##_32
#include "macrotask/cray/c_calls-inl.h"
#undef Word
#undef MACROTASK_NAME

MACROTASK_ENTRY void TSKLIST() { PrintTaskList(); }

MACROTASK_ENTRY void TSKTUNE(const char* keyword, long value, ...) {
  std::vector<TuningPair> pairs;
  va_list rest;
  va_start(rest, value);
  while (keyword != nullptr) {
    pairs.push_back({keyword, value});
    keyword = va_arg(rest, const char*);
    // An int or a long: the upper half of the word of an int is undefined.
    if (keyword != nullptr) value = static_cast<int>(va_arg(rest, long));
  }
  va_end(rest);
  RunCall(MACROTASK_CALL("TSKTUNE"), [&] { Tune(pairs); });
}

MACROTASK_ENTRY void BUFTUNE(const char* keyword, const char* value) {
  RunCall(MACROTASK_CALL("BUFTUNE"),
          [&] { TuneTrace(keyword, value == nullptr ? "" : value); });
}

MACROTASK_ENTRY void BUFUSER(long action, long data) {
  RunCall(MACROTASK_CALL("BUFUSER"),
          [&] { RecordUser(action, static_cast<std::uint64_t>(data)); });
}

MACROTASK_ENTRY void BUFPRINT() {
  RunCall(MACROTASK_CALL("BUFPRINT"), [] { PrintTrace(); });
}

MACROTASK_ENTRY void BUFDUMP() {
  RunCall(MACROTASK_CALL("BUFDUMP"), [] { DumpTrace(); });
}

MACROTASK_ENTRY double TSECND() { return CpuSeconds(); }

MACROTASK_ENTRY void MTTIMES() { PrintBusyTimes(); }

}  // namespace macrotask::cray
