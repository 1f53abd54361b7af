#pragma once

// Programs for relacy of a barrier with Sync(member).

namespace macrotask {

// What every task writes before the barrier every task reads after it, in
// memory that is not atomic: twice in a row, so that the next phase's writes
// must not overtake this one's reads. Task t is member (t + shift p) in phase
// p.
template <typename SomeBarrier, int num_tasks, int shift = 0>
struct EveryMemberReadsWhatAllWrote
    : rl::test_suite<
          EveryMemberReadsWhatAllWrote<SomeBarrier, num_tasks, shift>,
          num_tasks> {
  static constexpr int kNumRuns = num_tasks <= 3 ? 30000 : 3000;

  SomeBarrier barrier{num_tasks, WaitPolicy(), 1};
  rl::var<int> written[num_tasks];

  void thread(unsigned task) {
    int member = static_cast<int>(task);
    for (int phase = 0; phase < 2; ++phase) {
      written[task](RL_INFO) = phase;
      barrier.Sync(member);
      for (auto& other : written) RL_ASSERT(other(RL_INFO) == phase);
      member = (member + shift) % num_tasks;
      barrier.Sync(member);
      member = (member + shift) % num_tasks;
    }
  }
};

}  // namespace macrotask
