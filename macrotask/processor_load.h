#pragma once

#include <atomic>

#include "macrotask/cache_line.h"
#include "macrotask/task_record.h"

namespace macrotask {

// Internal: the tasks that share one processor, of those that RunTasks() has
// placed on it because there are more tasks than processors. As Load a hint
// that chooses between ways to wait: relaxed everywhere, publishes nothing.
struct alignas(kCacheLine) ProcessorLoad {
  int index = 0;  // of the processor, in [0, NumProcessorLoads())

  // Those that do not sleep.
  std::atomic<int> num_awake{0};

  void Add(int change) {
    num_awake.fetch_add(change, std::memory_order_relaxed);
  }
  bool IsAlone() const {
    return num_awake.load(std::memory_order_relaxed) <= 1;
  }
};

// Internal: one for each processor that the process may use, whatever the
// maximum set by SetMaxProcessors().
int NumProcessorLoads();
ProcessorLoad& LoadOfProcessor(int index);

// Internal: that of the calling task; null if it is none of these.
inline constinit thread_local ProcessorLoad* load_of_own_processor
    MACROTASK_TLS = nullptr;

// Internal: the calling task shares a processor for the length of a block, at
// whose beginning it has been counted.
class [[nodiscard]] ScopedProcessorLoad {
 public:
  explicit ScopedProcessorLoad(ProcessorLoad* shared)
      : shared_(shared), before_(load_of_own_processor) {
    load_of_own_processor = shared;
  }
  ~ScopedProcessorLoad() {
    load_of_own_processor = before_;
    if (shared_ != nullptr) shared_->Add(-1);
  }
  ScopedProcessorLoad(const ScopedProcessorLoad&) = delete;
  ScopedProcessorLoad& operator=(const ScopedProcessorLoad&) = delete;

 private:
  ProcessorLoad* const shared_;
  ProcessorLoad* const before_;  // of the task that runs other tasks
};

}  // namespace macrotask
