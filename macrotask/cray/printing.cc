#include "macrotask/cray/printing.h"

#include <cstdio>
#include <string>

#include "macrotask/busy_time.h"
#include "macrotask/task_list.h"
#include "macrotask/trace.h"
#include "macrotask/trace_text.h"

namespace macrotask::cray {
namespace {

void Print(const std::string& text) {
  std::fputs(text.c_str(), stdout);
  std::fflush(stdout);
}

}  // namespace

void PrintTaskList() { Print(ToString(ListTasks())); }

void PrintTrace() { Print(ToText(TakeTrace())); }

void PrintBusyTimes() { Print(ToString(BusyTimes())); }

}  // namespace macrotask::cray
