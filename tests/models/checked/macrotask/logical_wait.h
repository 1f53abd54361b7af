#pragma once

// In place of macrotask/logical_wait.h: a task is logical if the program under
// check says so.

#include <array>

namespace macrotask {

class LogicalProcessor;

inline std::array<LogicalProcessor*, 8> processor_of_task;
struct ProcessorOfCaller {
  operator LogicalProcessor*() const {
    return processor_of_task[rl::thread_index()];
  }
  void operator=(LogicalProcessor* processor) const {
    processor_of_task[rl::thread_index()] = processor;
  }
};
inline constexpr ProcessorOfCaller processor_of_caller;

inline void GiveWay() {}

}  // namespace macrotask
