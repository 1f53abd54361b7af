// The memory orders of Epoch, by relacy, and who may destroy it when.

#include <optional>

#include "macrotask/epoch.cc"
#include "tests/models/checked/check.h"

namespace macrotask {
namespace {

constexpr WaitPolicy kPolicy;  // Any: SpinThenSleep() is checked with them all.

// Two tasks write and advance, a third one reads what both wrote.
struct WaiterReadsWhatAllWrote : rl::test_suite<WaiterReadsWhatAllWrote, 3> {
  static constexpr int kNumRuns = 20000;

  Epoch epoch;
  rl::var<int> written[2];

  void thread(unsigned task) {
    if (task < 2) {
      written[task](RL_INFO) = 1;
      epoch.Advance();
    } else {
      epoch.AwaitPast(0, kPolicy);
      epoch.AwaitPast(1, kPolicy);
      RL_ASSERT(written[0](RL_INFO) + written[1](RL_INFO) == 2);
    }
  }
};

// The same by Read() alone.
struct ReaderReadsWhatWasWritten
    : rl::test_suite<ReaderReadsWhatWasWritten, 2> {
  static constexpr int kNumRuns = 20000;

  Epoch epoch;
  rl::var<int> written;

  void thread(unsigned task) {
    if (task == 0) {
      written(RL_INFO) = 1;
      epoch.Advance();
    } else if (epoch.Read() == 1) {
      RL_ASSERT(written(RL_INFO) == 1);
    }
  }
};

// One task advances to one epoch after the other, two wait for them.
struct WaitersReadWhatTheOnlyAdvancerWrote
    : rl::test_suite<WaitersReadWhatTheOnlyAdvancerWrote, 3> {
  static constexpr int kNumRuns = 20000;
  static constexpr int kNumEpochs = 2;

  Epoch epoch;
  rl::var<int> written[kNumEpochs];

  void thread(unsigned task) {
    for (unsigned i = 0; i < kNumEpochs; ++i) {
      if (task == 0) {
        written[i](RL_INFO) = 1;
        epoch.AdvanceTo(i + 1);
      } else {
        epoch.AwaitPast(i, kPolicy);
        RL_ASSERT(written[i](RL_INFO) == 1);
      }
    }
  }
};

struct ReleasedTaskDestroysIt : rl::test_suite<ReleasedTaskDestroysIt, 2> {
  static constexpr int kNumRuns = 50000;

  std::optional<Epoch> epoch{std::in_place};
  rl::var<int> written;

  void thread(unsigned task) {
    if (task == 0) {
      written(RL_INFO) = 1;
      epoch->Advance();
    } else {
      epoch->AwaitPast(0, kPolicy);
      RL_ASSERT(written(RL_INFO) == 1);
      epoch.reset();
    }
  }
};

// As an event: whoever posts has written before, whoever clears looks before he
// waits. A look that misses the write must not be followed by a wait without
// end. The data is atomic, so that all depends on the event.
struct ClearLookWaitMissesNothing
    : rl::test_suite<ClearLookWaitMissesNothing, 2> {
  static constexpr int kNumRuns = 50000;

  Epoch epoch;
  checked::UncheckedAtomic<int> written{0};

  void thread(unsigned task) {
    for (int item = 1; item <= 2; ++item) {
      if (task == 0) {
        written.store(item, rl::mo_relaxed, RL_INFO);
        epoch.AdvanceIfEven();  // Post()
        continue;
      }
      for (;;) {
        epoch.AdvanceIfOdd();  // Clear()
        if (written.load(rl::mo_relaxed, RL_INFO) >= item) break;
        const std::uint64_t seen = epoch.Read();
        if (seen % 2 == 0) epoch.AwaitPast(seen, kPolicy);  // Wait()
      }
    }
  }
};

// Who advances sees in full what was written before the advances that he knows
// of: a clearer what was written before the post.
template <void (Epoch::*first)(), void (Epoch::*second)()>
struct AdvancerReadsWhatWasWritten
    : rl::test_suite<AdvancerReadsWhatWasWritten<first, second>, 2> {
  static constexpr int kNumRuns = 20000;

  Epoch epoch;
  checked::UncheckedAtomic<int> has_advanced{0};
  rl::var<int> written;

  void thread(unsigned task) {
    if (task == 0) {
      written(RL_INFO) = 1;
      (epoch.*first)();
      has_advanced.store(1, rl::mo_relaxed, RL_INFO);
    } else if (has_advanced.load(rl::mo_relaxed, RL_INFO) == 1) {
      (epoch.*second)();
      RL_ASSERT(written(RL_INFO) == 1);
    }
  }
};
using ClearerReadsWhatWasWritten =
    AdvancerReadsWhatWasWritten<&Epoch::AdvanceIfEven, &Epoch::AdvanceIfOdd>;
using SecondReadsWhatFirstWrote =
    AdvancerReadsWhatWasWritten<&Epoch::Advance, &Epoch::Advance>;

}  // namespace
}  // namespace macrotask

int main() {
  using namespace macrotask;
  return checked::Check(
      {
          &checked::Search<WaiterReadsWhatAllWrote>,
          &checked::Search<ReaderReadsWhatWasWritten>,
          &checked::Search<WaitersReadWhatTheOnlyAdvancerWrote>,
          &checked::Search<ReleasedTaskDestroysIt>,
          &checked::Search<ClearLookWaitMissesNothing>,
          &checked::Search<ClearerReadsWhatWasWritten>,
          &checked::Search<SecondReadsWhatFirstWrote>,
      },
      {});
}
