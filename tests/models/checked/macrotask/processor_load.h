#pragma once

// In place of macrotask/processor_load.h: nobody counts, and whether a task is
// alone is left to chance, as the hint may be wrong at any time.

#include <array>

namespace macrotask {

struct ProcessorLoad {
  int index;

  void Add(int) {}
  bool IsAlone() const { return rl::rand(3) != 0; }
};

inline std::array<ProcessorLoad, 2> processor_loads = {{{0}, {1}}};
inline int NumProcessorLoads() {
  return static_cast<int>(processor_loads.size());
}
inline ProcessorLoad& LoadOfProcessor(int index) {
  return processor_loads[static_cast<std::size_t>(index)];
}

// Those of the tasks of the program under check, which chooses them; null at
// first.
inline std::array<ProcessorLoad*, 8> load_of_task;
struct LoadOfOwnProcessor {
  operator ProcessorLoad*() const { return load_of_task[rl::thread_index()]; }
  void operator=(ProcessorLoad* shared) const {
    load_of_task[rl::thread_index()] = shared;
  }
};
inline constexpr LoadOfOwnProcessor load_of_own_processor;

}  // namespace macrotask
