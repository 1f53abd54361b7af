#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

#include "macrotask/cache_line.h"
#include "macrotask/epoch.h"
#include "macrotask/wait_policy.h"
#include "macrotask/waited_object.h"

namespace macrotask {

// Internal: a barrier in rounds, after each of which a member knows of twice as
// many arrivals: in round r it tells the member 2^r further on, in a circle, and
// is told by the one 2^r before. Nobody is the last and nobody the root. Of 2
// members, it is a pair of flags, one line each way. Same contract as
// Barrier::Sync(member).
//
// Source: Hensgen, Finkel, Manber, "Two algorithms for barrier
// synchronization", 1988; [Mellor-Crummey and Scott 1991], algorithm 3.
// Cost: ceil(log2 n) rounds of two line transfers, one that takes the line for
// writing and one that fetches it; n ceil(log2 n) flags of two lines each.
class DisseminationBarrier {
 public:
  // Requires: `num_tasks` >= 1. `number` is that of the Barrier.
  DisseminationBarrier(int num_tasks, const WaitPolicy& policy,
                       std::uint32_t number);
  ~DisseminationBarrier();
  DisseminationBarrier(const DisseminationBarrier&) = delete;
  DisseminationBarrier& operator=(const DisseminationBarrier&) = delete;

  // Requires: 0 <= `member` < `num_tasks`.
  void Sync(int member);

  // Number of members that have arrived and whose phase is not complete.
  int num_waiting() const;

 private:
  // Of one member, and its own.
  struct alignas(kCacheLine) Phases {
    std::uint64_t arrived = 0;  // in so many
  };

  // What `member` waits for in `round`; the phase that it has been told of.
  Epoch& flag(int member, int round) const {
    return flags_[static_cast<std::size_t>(member * num_rounds_ + round)];
  }

  const int num_tasks_;
  const int num_rounds_;  // ceil(log2 num_tasks)
  const WaitPolicy policy_;
  const WaitedObject waited_;
  std::unique_ptr<Epoch[]> flags_;          // (num_tasks x num_rounds)
  const std::unique_ptr<Phases[]> phases_;  // (num_tasks)
};

}  // namespace macrotask
