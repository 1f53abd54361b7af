#include "macrotask/undecided_barrier.h"

#include "macrotask/logical_wait.h"

// All arrive at the same one of the two, as the choice never changes, and the
// other one has no part in anything. The choice publishes nothing: both are
// there before whoever made the barrier shows it to another task. Hence relaxed.

namespace macrotask {

void UndecidedBarrier::Sync() {
  Choice choice = choice_.load(std::memory_order_relaxed);
  if (choice == Choice::kNone) choice = Decide();
  if (choice == Choice::kLogical) return logical_.Sync();
  two_level_.Sync();
}

UndecidedBarrier::Choice UndecidedBarrier::Decide() {
  Choice choice = Choice::kNone;
  const Choice mine =
      processor_of_caller != nullptr ? Choice::kLogical : Choice::kTwoLevel;
  const bool is_first = choice_.compare_exchange_strong(
      choice, mine, std::memory_order_relaxed, std::memory_order_relaxed);
  return is_first ? mine : choice;
}

}  // namespace macrotask
