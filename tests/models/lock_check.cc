// The memory orders of Lock, by relacy, with the Epoch by which it is handed
// over.

#include "macrotask/epoch.cc"
#include "macrotask/lock.cc"
#include "tests/models/checked/check.h"

namespace macrotask {

std::uint32_t NextNumber(ObjectKind) { return 1; }

namespace {

// What is guarded is not atomic. Each task locks in its own way and waits in
// every way.
template <int num_tasks>
struct HolderIsAlone : rl::test_suite<HolderIsAlone<num_tasks>, num_tasks> {
  static constexpr int kNumRuns = 20000;

  Lock lock;
  rl::var<int> guarded;
  rl::var<int> num_turns;

  void before() {
    lock.Off();  // Harmless on a clear lock.
    RL_ASSERT(!lock.is_set());
    guarded(RL_INFO) = 0;
  }

  void thread(unsigned) {
    for (int turn = 0; turn < 2; ++turn) {
      if (rl::rand(4) == 0) {
        while (lock.Test()) rl::yield(1, RL_INFO);
      } else {
        lock.On();
      }
      guarded(RL_INFO) = guarded(RL_INFO) + 1;
      lock.Off();
    }
  }

  void after() {
    RL_ASSERT(!lock.is_set());
    RL_ASSERT(lock.num_waiting() == 0);
    RL_ASSERT(guarded(RL_INFO) == 2 * num_tasks);
  }
};

}  // namespace
}  // namespace macrotask

int main() {
  using namespace macrotask;
  return checked::Check(
      {
          &checked::Search<HolderIsAlone<2>>,
          &checked::Search<HolderIsAlone<3>>,
      },
      // A lock needs no more of an advance; epoch_check.cc does.
      {"Advance() change acq_rel -> release"});
}
