// The memory orders of CountingBarrier, by relacy.

#include "macrotask/counting_barrier.cc"
#include "tests/models/checked/check.h"

namespace macrotask {
namespace {

// What every task writes before the barrier every task reads after it, in
// memory that is not atomic: twice in a row, so that the next phase's writes
// must not overtake this one's reads.
template <int num_tasks>
struct EveryTaskReadsWhatAllWrote
    : rl::test_suite<EveryTaskReadsWhatAllWrote<num_tasks>, num_tasks> {
  static constexpr int kNumRuns = 50000;

  CountingBarrier barrier{num_tasks, WaitPolicy(), 1};
  rl::var<int> written[num_tasks];

  void thread(unsigned task) {
    for (int phase = 0; phase < 2; ++phase) {
      written[task](RL_INFO) = phase;
      barrier.Sync();
      for (auto& other : written) RL_ASSERT(other(RL_INFO) == phase);
      barrier.Sync();
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
      {});
}
