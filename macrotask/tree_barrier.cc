#include "macrotask/tree_barrier.h"

#include <algorithm>
#include <cstddef>

#include "macrotask/program_end.h"

// Phases are counted from 1.
//
// Nobody leaves early. A member tells its parent of phase k after its children
// have told it of phase k: hence, from the leaves up, after all of its subtree
// have arrived. The root releases phase k after all have. What they wrote comes
// along the same way, from release to acquire.
//
// Phases do not mix, with one set of flags and nothing to reset. A child tells
// of phase k + 1 after phase k is released, which is after its parent has seen
// it tell of phase k; and phase k + 1 is not released before whoever waits for
// phase k has left it and arrived again. So no flag is ahead when somebody
// looks, and each has reached phase k - 1 when its reader waits for it to pass
// that, as it waited for this in the phase before. (If another task was the
// member then, all that it saw is ordered by the end of that phase.)
//
// One flag releases all, not a tree of them: where caches are coherent all who
// spin fetch it at once, and those who sleep are woken by one broadcast, where
// in a tree each would be woken, 20 us later, by one who was woken himself.
//
// That nobody who sleeps is lost is a matter of Epoch.

namespace macrotask {
namespace {

// Children of a node. More make fewer levels, and more lines that a parent has
// to fetch one after the other: 4 is what [Mellor-Crummey and Scott 1991] found
// best.
constexpr int kFanIn = 4;

}  // namespace

TreeBarrier::TreeBarrier(int num_tasks, const WaitPolicy& policy,
                         std::uint32_t number)
    : num_tasks_(num_tasks),
      policy_(policy),
      waited_{ObjectKind::kBarrier, number},
      nodes_(new Node[static_cast<std::size_t>(num_tasks)]) {}

TreeBarrier::~TreeBarrier() {
  // Tasks may still look at them.
  if (caller_stops_program) (void)nodes_.release();
}

void TreeBarrier::Sync(int member) {
  Node& node = nodes_[static_cast<std::size_t>(member)];
  // Relaxed: nobody else writes it, and it publishes nothing.
  const std::uint64_t phase = node.arrived.load(std::memory_order_relaxed) + 1;
  node.arrived.store(phase, std::memory_order_relaxed);
  AwaitChildren(member, phase);
  if (member == 0) return released_.AdvanceTo(phase);
  node.complete.AdvanceTo(phase);
  released_.AwaitPast(phase - 1, policy_, waited_);
}

void TreeBarrier::AwaitChildren(int member, std::uint64_t phase) {
  const int first = kFanIn * member + 1;
  const int end = std::min(first + kFanIn, num_tasks_);
  for (int child = first; child < end; ++child) {
    nodes_[static_cast<std::size_t>(child)].complete.AwaitPast(
        phase - 1, policy_, waited_);
  }
}

int TreeBarrier::num_waiting() const {
  const std::uint64_t released = released_.Read();
  return static_cast<int>(
      std::count_if(&nodes_[0], &nodes_[0] + num_tasks_, [&](const Node& node) {
        return node.arrived.load(std::memory_order_relaxed) > released;
      }));
}

}  // namespace macrotask
