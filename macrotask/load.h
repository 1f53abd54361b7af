#pragma once

#include <atomic>

#include "macrotask/cache_line.h"
#include "macrotask/wait_policy.h"

namespace macrotask {

// Internal: how crowded the processors are. A hint that chooses between ways to
// wait, each of which is right: relaxed everywhere, publishes nothing.
struct alignas(kCacheLine) Load {
  // Tasks that want a processor now, the initial task included.
  std::atomic<int> num_tasks{1};
  // NumProcessors(), on the same line for those who compare. 0, hence crowded,
  // until the library is loaded.
  std::atomic<int> num_processors{0};
};
inline constinit Load load;

inline void EnterLoad() {
  load.num_tasks.fetch_add(1, std::memory_order_relaxed);
}
inline void LeaveLoad() {
  load.num_tasks.fetch_sub(1, std::memory_order_relaxed);
}

inline bool MoreTasksThanProcessors() {
  return load.num_tasks.load(std::memory_order_relaxed) >
         load.num_processors.load(std::memory_order_relaxed);
}

// Internal: the caller is no live task for the length of a block in which it
// waits for others to complete.
class [[nodiscard]] ScopedLeaveLoad {
 public:
  ScopedLeaveLoad() { LeaveLoad(); }
  ~ScopedLeaveLoad() { EnterLoad(); }
  ScopedLeaveLoad(const ScopedLeaveLoad&) = delete;
  ScopedLeaveLoad& operator=(const ScopedLeaveLoad&) = delete;
};

// Internal: how a task that is about to leave the load waits: never spinning
// for ever, and not at all if that takes a processor from a live task. To be
// called while the caller still counts: afterwards the others may just fill the
// processors, and the caller would spin against them.
inline WaitPolicy IdlePolicy(const WaitPolicy& policy) {
  if (MoreTasksThanProcessors()) return WaitPolicy::Block();
  if (policy.kind == WaitKind::kSpin) return WaitPolicy::Hold();
  return policy;
}

}  // namespace macrotask
