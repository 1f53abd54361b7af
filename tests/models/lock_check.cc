// The memory orders of Lock, by relacy, with the Epoch by which it is handed
// over.

#include "macrotask/epoch.cc"
#include "macrotask/lock.cc"
#include "tests/models/checked/check.h"

namespace macrotask {

std::uint32_t NextNumber(ObjectKind) { return 1; }

namespace {

// Before the lock, which asks for it.
struct Fences {
  explicit Fences(bool has_them) { has_heavy_fence = has_them; }
};

// What is guarded is not atomic. Each task locks in its own way and waits in
// every way.
template <int num_tasks, bool has_fences>
struct HolderIsAlone
    : rl::test_suite<HolderIsAlone<num_tasks, has_fences>, num_tasks> {
  static constexpr int kNumRuns = 20000;

  Fences fences{has_fences};
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

// Two tasks unlock the same lock while others lock: these may hold it at the
// same time, but nobody may be lost, and each must see what was written by one
// at least of those who have unlocked.
struct NobodyIsLost : rl::test_suite<NobodyIsLost, 4> {
  static constexpr int kNumRuns = 40000;

  Fences fences{true};
  Lock lock;
  checked::UncheckedAtomic<int> written[2] = {0, 0};

  void before() { lock.On(); }

  void thread(unsigned task) {
    if (task < 2) {
      written[task].store(1, rl::mo_relaxed, RL_INFO);
      return lock.Off();
    }
    for (int turn = 0; turn < 2; ++turn) {
      if (task == 2) {
        lock.On();
      } else {
        while (lock.Test()) rl::yield(1, RL_INFO);
      }
      RL_ASSERT(written[0].load(rl::mo_relaxed, RL_INFO) == 1 ||
                written[1].load(rl::mo_relaxed, RL_INFO) == 1);
      lock.Off();
    }
  }

  void after() { RL_ASSERT(lock.num_waiting() == 0); }
};

}  // namespace
}  // namespace macrotask

int main() {
  using namespace macrotask;
  return checked::Check(
      {
          &checked::Search<HolderIsAlone<2, true>>,
          &checked::Search<HolderIsAlone<3, true>>,
          &checked::Search<HolderIsAlone<2, false>>,
          &checked::Search<HolderIsAlone<3, false>>,
          &checked::Search<NobodyIsLost>,
      },
      // A lock needs no more of an advance; epoch_check.cc does.
      {"Advance() change acq_rel -> release"});
}
