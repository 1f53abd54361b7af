#include "macrotask/dissemination_barrier.h"

#include <algorithm>
#include <bit>
#include <limits>

#include "macrotask/program_end.h"

// Let n be the number of members and phases be counted from 1. Indices are
// modulo n.
//
// Nobody leaves early. After round r of phase k, member i knows, and has
// acquired, that i, i - 1, ..., i - (2^(r+1) - 1) have arrived in phase k.
// Before the first round it knows that of itself. In round r it is told by
// i - 2^r, which has been through the rounds before and so knows of as many
// members, those just before the ones that i knows of. After ceil(log2 n)
// rounds that is the whole circle.
//
// Phases do not mix, with one set of flags and nothing to reset. A flag is
// advanced by one member only, from phase to phase. Whoever tells of phase
// k + 1 has left phase k, for which all have arrived; of phase k + 2, has left
// phase k + 1, for which the member told has arrived, which therefore waits for
// phase k no more. So a flag is at most one phase ahead when a slow member
// looks, hence greater than k - 1 and never equal to k.
//
// A flag has reached phase k - 1 when its member waits for it to pass that: the
// member waited for this in the phase before. (If another task was the member
// then, all that it saw is ordered by the end of that phase; so is phases_.)
//
// That nobody who sleeps is lost is a matter of Epoch.

namespace macrotask {

DisseminationBarrier::DisseminationBarrier(int num_tasks,
                                           const WaitPolicy& policy,
                                           std::uint32_t number)
    : num_tasks_(num_tasks),
      num_rounds_(std::bit_width(static_cast<unsigned>(num_tasks - 1))),
      policy_(policy),
      waited_{ObjectKind::kBarrier, number},
      flags_(new Epoch[static_cast<std::size_t>(num_tasks * num_rounds_)]),
      phases_(new Phases[static_cast<std::size_t>(num_tasks)]) {}

DisseminationBarrier::~DisseminationBarrier() {
  // Tasks may still look at them.
  if (caller_stops_program) (void)flags_.release();
}

void DisseminationBarrier::Sync(int member) {
  const std::uint64_t phase =
      ++phases_[static_cast<std::size_t>(member)].arrived;
  int partner = member + 1;
  for (int round = 0; round < num_rounds_; ++round) {
    if (partner >= num_tasks_) partner -= num_tasks_;
    flag(partner, round).AdvanceTo(phase);
    flag(member, round).AwaitPast(phase - 1, policy_, waited_);
    partner += 1 << round;
  }
}

int DisseminationBarrier::num_waiting() const {
  if (num_rounds_ == 0) return 0;
  // The flag of round 0 counts the arrivals of the member before. They differ
  // by one at most, and whoever is ahead waits for the others.
  std::uint64_t least = std::numeric_limits<std::uint64_t>::max();
  int num_least = 0;
  for (int member = 0; member < num_tasks_; ++member) {
    const std::uint64_t arrivals = flag(member, 0).Read();
    if (arrivals < least) num_least = 0;
    least = std::min(least, arrivals);
    if (arrivals == least) ++num_least;
  }
  return num_tasks_ - num_least;
}

}  // namespace macrotask
