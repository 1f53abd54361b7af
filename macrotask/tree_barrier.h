#pragma once

#include <atomic>
#include <cstdint>
#include <memory>

#include "macrotask/cache_line.h"
#include "macrotask/epoch.h"
#include "macrotask/wait_policy.h"
#include "macrotask/waited_object.h"

namespace macrotask {

// Internal: a barrier whose members form a tree: each waits for its children,
// then tells its parent; the root, member 0, tells all. Same contract as
// Barrier::Sync(member).
//
// Source: the arrival tree of [Mellor-Crummey and Scott 1991], algorithm 5, and
// their release by one flag.
// Cost: two line transfers a level, of which there are log4 n, for the child
// takes its line and the parent fetches it, and up to three fetches more if all
// children come at once; two for the release. 3 n transfers in all.
class TreeBarrier {
 public:
  // Requires: `num_tasks` >= 1. `number` is that of the Barrier.
  TreeBarrier(int num_tasks, const WaitPolicy& policy, std::uint32_t number);
  ~TreeBarrier();
  TreeBarrier(const TreeBarrier&) = delete;
  TreeBarrier& operator=(const TreeBarrier&) = delete;

  // Requires: 0 <= `member` < `num_tasks`.
  void Sync(int member);

  // Number of members that have arrived and whose phase is not complete.
  int num_waiting() const;

 private:
  struct Node {
    Epoch complete;  // last phase in which the node and all below have arrived
    // Phases in which the member itself has arrived. Written by that only, read
    // by those who look from outside.
    alignas(kCacheLine) std::atomic<std::uint64_t> arrived{0};
  };

  void AwaitChildren(int member, std::uint64_t phase);

  const int num_tasks_;
  const WaitPolicy policy_;
  const WaitedObject waited_;
  std::unique_ptr<Node[]> nodes_;  // (num_tasks), that of the root unused
  Epoch released_;                 // last phase that is complete
};

}  // namespace macrotask
