#pragma once

#include <atomic>

#include "macrotask/logical_barrier.h"
#include "macrotask/two_level_barrier.h"

namespace macrotask {

// Internal: a barrier for more tasks than processors of which nobody has said
// how they wait (WaitKind::kAuto). The first to arrive decides, once and for
// all: if it is a logical task, this is a LogicalBarrier, otherwise a
// TwoLevelBarrier. Either serves the other kind of task as well, only slower.
class UndecidedBarrier {
 public:
  // Requires: `num_tasks` >= 1. `number` is that of the Barrier.
  UndecidedBarrier(int num_tasks, const WaitPolicy& policy,
                   std::uint32_t number)
      : two_level_(num_tasks, policy, number), logical_(num_tasks, number) {}
  UndecidedBarrier(const UndecidedBarrier&) = delete;
  UndecidedBarrier& operator=(const UndecidedBarrier&) = delete;

  void Sync();

  // Number of tasks that have arrived and whose phase is not complete.
  int num_waiting() const {
    return two_level_.num_waiting() + logical_.num_waiting();
  }

 private:
  enum class Choice { kNone, kTwoLevel, kLogical };

  Choice Decide();

  std::atomic<Choice> choice_{Choice::kNone};
  TwoLevelBarrier two_level_;
  LogicalBarrier logical_;
};

}  // namespace macrotask
