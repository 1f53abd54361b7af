#include "bench/sync_samples.h"

#include <gtest/gtest.h>

#include <atomic>

#include "bench/sync_bare.h"
#include "bench/sync_operations.h"
#include "bench/sync_rows.h"
#include "macrotask/barrier.h"
#include "macrotask/event.h"

namespace bench {
namespace {

// Samples of 2 us a call, of which 0.5 us are the loop's.
SyncSeries Series(const std::vector<double>& round_trips) {
  SyncSeries series;
  series.variant.construct = "BARSYNC";
  series.variant.by = "hold";
  series.calls = 512;
  for (const double round_trip : round_trips) {
    SyncSample sample;
    sample.seconds = 2e-6;
    sample.reference = 0.5e-6;
    sample.conditions.before.round_trip = round_trip;
    sample.conditions.after.round_trip = round_trip;
    series.samples.push_back(sample);
  }
  return series;
}

TEST(CallsForTarget, DoublesUntilTheSampleIsLongEnough) {
  std::vector<long> asked;
  const long calls = CallsForTarget(
      [&](long n) {
        asked.push_back(n);
        return static_cast<double>(n) * 0.3e-3;
      },
      1e-3, 1000);
  EXPECT_EQ(calls, 4);
  EXPECT_EQ(asked, (std::vector<long>{1, 2, 4}));
}

TEST(CallsForTarget, IsOneForASlowConstruct) {
  EXPECT_EQ(CallsForTarget([](long) { return 6e-3; }, 1e-3, 1000), 1);
}

TEST(CallsForTarget, StopsAtTheMost) {
  EXPECT_EQ(CallsForTarget([](long) { return 0.0; }, 1e-3, 1000), 1000);
}

TEST(FairnessOf, IsTheFewestOverTheMost) {
  EXPECT_EQ(FairnessOf({100, 50, 200}), 0.25);
  EXPECT_EQ(FairnessOf({7}), 1);
  EXPECT_EQ(FairnessOf({0, 5}), 0);
  EXPECT_EQ(FairnessOf({0, 0}), 1);
}

TEST(Overheads, AreTheLoopLessItsReferenceByPart) {
  SyncSample a, b;
  a.seconds = 10e-6;
  a.reference = 4e-6;
  b.seconds = 9e-6;
  b.reference = 5e-6;
  const std::vector<double> one = Overheads({a, b}, 1);
  const std::vector<double> half = Overheads({a, b}, 2);
  EXPECT_DOUBLE_EQ(one[0], 6e-6);
  EXPECT_DOUBLE_EQ(one[1], 4e-6);
  EXPECT_DOUBLE_EQ(half[0], 3e-6);
}

TEST(MakeRows, GivesOneRowForEachDistance) {
  const std::vector<SyncSeries> series = {
      Series({70e-9, 72e-9, 200e-9, 71e-9, 210e-9})};
  const DistanceSplit split = SplitOf(series);
  const std::vector<SyncRow> rows = MakeRows(series, split);
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0].distance, Distance::kNear);
  EXPECT_EQ(rows[0].overhead->n, 3);
  EXPECT_EQ(rows[1].distance, Distance::kFar);
  EXPECT_EQ(rows[1].overhead->n, 2);
  EXPECT_DOUBLE_EQ(rows[0].overhead->median, 1.5e-6);
}

TEST(MakeRows, CountsWhatItDrops) {
  SyncSeries series = Series({70e-9, 70e-9, 70e-9});
  series.samples[1].conditions.switches = 4;
  series.samples[1].seconds = 1;
  const std::vector<SyncRow> rows = MakeRows({series}, SplitOf({series}));
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_EQ(rows[0].dropped.switched, 1);
  EXPECT_EQ(rows[0].overhead->n, 2);
  EXPECT_DOUBLE_EQ(rows[0].total, 2e-6);
}

TEST(MakeRows, HasNoFiguresWhereAllIsDisturbedOrMissing) {
  SyncSeries disturbed = Series({70e-9});
  disturbed.samples[0].conditions.switches = 1;
  SyncSeries missing = Series({});
  missing.variant.missing = "not installed";
  const std::vector<SyncRow> rows =
      MakeRows({disturbed, missing}, SplitOf({disturbed}));
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_FALSE(rows[0].overhead);
  EXPECT_FALSE(rows[1].overhead);
  EXPECT_EQ(rows[1].variant.missing, "not installed");
}

// --- The loop ---------------------------------------------------------------

class Loop : public testing::TestWithParam<int> {
 protected:
  template <typename Operation>
  LoopTiming Run(Operation* operation, const LoopSpec& spec) {
    NoMarks none;
    return RunLoop(*operation, Pthreads(), spec, none);
  }
  Team Pthreads() const {
    return MakePthreadTeam(GetParam(), SyncPlacement::kPinned);
  }
};

struct LibraryBarrier {
  explicit LibraryBarrier(int num_tasks) : barrier(num_tasks) {}
  void Sync(int) { barrier.Sync(); }
  macrotask::Barrier barrier;
};

TEST_P(Loop, MakesAsManyCallsInEveryTask) {
  BarrierOperation<LibraryBarrier> operation(GetParam());
  const LoopTiming timing = Run(&operation, {.calls = 50});
  EXPECT_EQ(timing.calls,
            std::vector<long>(static_cast<std::size_t>(GetParam()), 50));
  EXPECT_EQ(timing.total_calls(), 50 * GetParam());
}

TEST_P(Loop, StopsAllTasksAfterTheSameCallWhenTimeIsUp) {
  BarrierOperation<LibraryBarrier> operation(GetParam());
  const LoopTiming timing = Run(&operation, {.calls = 1l << 40, .limit = 0});
  for (const long calls : timing.calls) EXPECT_EQ(calls, timing.calls[0]);
}

TEST_P(Loop, StopsARaceOfTasksThatDoNotWaitForEachOther) {
  std::atomic<long> count = 0;
  const auto add = [&] { count.fetch_add(1); };
  SimpleOperation<decltype(add)> operation(add);
  const LoopTiming timing =
      Run(&operation, {.calls = 1l << 40, .limit = 1e-3, .race = true});
  EXPECT_EQ(timing.total_calls(), count.load());
}

// What the waiters count has been posted: nobody takes a post twice.
TEST_P(Loop, LetsEveryWaiterThroughOnceForEachPost) {
  EventOperation<macrotask::Event> operation(GetParam());
  Marks marks(GetParam(), 200);
  RunLoop(operation, Pthreads(), {.calls = 200}, marks);
  const std::vector<TaskMarks> tasks = marks.Take();
  ASSERT_EQ(tasks[0].in.size(), 200u);
  for (std::size_t t = 1; t < tasks.size(); ++t) {
    ASSERT_EQ(tasks[t].out.size(), 200u);
    for (std::size_t call = 0; call + 1 < 200; ++call) {
      EXPECT_LT(tasks[t].out[call], tasks[0].in[call + 1]);
    }
  }
}

TEST_P(Loop, KeepsABareLockToOneTask) {
  struct CountedLock : ExchangeLock {
    void On() {
      ExchangeLock::On();
      ++count;
    }
    long count = 0;
  };
  struct Shared {
    explicit Shared(CountedLock* l) : lock(l) {}
    void On() { lock->On(); }
    void Off() { lock->Off(); }
    CountedLock* lock;
  };
  CountedLock lock;
  LockOperation<Shared> operation(0, &lock);
  Run(&operation, {.calls = 100});
  EXPECT_EQ(lock.count, 100 * GetParam());
}

INSTANTIATE_TEST_SUITE_P(NumTasks, Loop, testing::Values(2, 3, 4, 7, 16));

TEST(PairwiseFlags, LetsNobodyPastBeforeTheOther) {
  BarrierOperation<PairwiseFlags> operation(2);
  Marks marks(2, 100);
  RunLoop(operation, MakePthreadTeam(2, SyncPlacement::kPinned),
          {.calls = 100, .limit = 5}, marks);
  const std::vector<TaskMarks> tasks = marks.Take();
  for (const double seconds :
       CalcLatencies(LatencyKind::kLastInLastOut, tasks).last) {
    EXPECT_GE(seconds, 0);
  }
  EXPECT_EQ(tasks[0].out.size(), tasks[1].out.size());
}

}  // namespace
}  // namespace bench
