// The memory orders of TwoLevelBarrier, by relacy.

#include "macrotask/two_level_barrier.cc"
#include "tests/models/checked/check.h"

namespace macrotask {
namespace {

// What every task writes before the barrier every task reads after it, in
// memory that is not atomic: twice in a row, so that the next phase's writes
// must not overtake this one's reads. A task may be of either processor, or of
// none, and of another one in each phase.
template <int num_tasks>
struct EveryTaskReadsWhatAllWrote
    : rl::test_suite<EveryTaskReadsWhatAllWrote<num_tasks>, num_tasks> {
  static constexpr int kNumRuns = 50000;

  TwoLevelBarrier barrier{num_tasks, WaitPolicy(), 1};
  rl::var<int> written[num_tasks];

  void before() { ForgetSleepers(); }

  void Sync() {
    const unsigned place = rl::rand(3);
    load_of_own_processor = place < 2 ? &processor_loads[place] : nullptr;
    barrier.Sync();
  }

  void thread(unsigned task) {
    for (int phase = 0; phase < 2; ++phase) {
      written[task](RL_INFO) = phase;
      Sync();
      for (auto& other : written) RL_ASSERT(other(RL_INFO) == phase);
      Sync();
    }
  }
};

}  // namespace
}  // namespace macrotask

int main() {
  using namespace macrotask;
  return checked::Check(
      {
          &checked::Search<EveryTaskReadsWhatAllWrote<2>>,
          &checked::Search<EveryTaskReadsWhatAllWrote<3>>,
      },
      {
          // Published by the arrival that follows. One who misses it wakes the
          // sleepers once too often.
          "Sync() store seq_cst -> release (1)",
          // A change is of the newest value whatever its order. Whoever counts
          // itself after this one sees the arrivals that it has seen.
          "WakeSleepers() change seq_cst -> acq_rel",
          "SleepUntil() change seq_cst -> acq_rel (2)",
          // To miss the number is to look again.
          "SleepUntil() load seq_cst -> acquire",
          // In C++ a compare-exchange that fails may read an old value, in
          // relacy it reads the newest: nothing is shown of these two.
          "WakeSleepers() failure seq_cst -> acquire",
          "SleepUntil() failure seq_cst -> acquire",
      });
}
