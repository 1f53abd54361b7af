#include "bench/trace_phases.h"

#include <gtest/gtest.h>

#include <map>
#include <vector>

#include "tests/bench/trace_example.h"

namespace bench {
namespace {

using enum macrotask::TraceAction;
using Phases = std::vector<BarrierPhase>;
using Skipped = std::map<std::uint32_t, std::uint64_t>;

TEST(FindPhases, NameWhoCameLastAndWhoBeforeThat) {
  Script one(1), two(2), three(3);
  one.Wait(1010, 1030, kBarrierSync, Data(5, 3))
      .Wait(1040, 1061, kBarrierSync, Data(5, 3));
  two.Wait(1020, 1031, kBarrierSync, Data(5, 3))
      .Wait(1060, 1062, kBarrierSync, Data(5, 3));
  // Leaves late: the next phase has begun already.
  three.Wait(1029, 1045, kBarrierSync, Data(5, 3))
      .Wait(1050, 1060, kBarrierSync, Data(5, 3));
  const BarrierPhases phases =
      FindPhases(HistoryOf({one.Buffer(), two.Buffer(), three.Buffer()}));
  EXPECT_EQ(phases.complete,
            (Phases{{5, 3, 1029, 1020, 3}, {5, 2, 1060, 1050, 3}}));
  EXPECT_TRUE(phases.skipped.empty());
}

TEST(FindPhases, TellBarriersFromEachOther) {
  Script one(1), two(2);
  one.Wait(1010, 1040, kBarrierSync, Data(5, 2))
      .Wait(1050, 1051, kBarrierSync, Data(6, 1));
  two.Wait(1020, 1021, kBarrierSync, Data(7, 1))
      .Wait(1030, 1041, kBarrierSync, Data(5, 2));
  EXPECT_EQ(FindPhases(HistoryOf({one.Buffer(), two.Buffer()})).complete,
            (Phases{{5, 2, 1030, 1010, 2},
                    {6, 1, 1050, 1050, 1},
                    {7, 2, 1020, 1020, 1}}));
}

TEST(FindPhases, PhaseThatNobodyLeftIsNone) {
  Script one(1);
  one.At(1010, kBarrierSync, Data(5, 2));
  const BarrierPhases phases = FindPhases(HistoryOf({one.Buffer()}));
  EXPECT_TRUE(phases.complete.empty());
  EXPECT_TRUE(phases.skipped.empty());
}

// Three tasks, always in the order 1, 2, 3 at k00, k10, k20; they leave at k30,
// k40, and task 3 after the others have arrived again. Of task 2 the records
// before `from` are lost.
TraceHistory PhasesFrom(std::uint64_t from, std::uint64_t num_phases) {
  Script scripts[] = {Script(1), Script(2), Script(3)};
  for (std::uint64_t k = 0; k < num_phases; ++k) {
    const std::uint64_t t = 1000 + 100 * k;
    const std::uint64_t begins[] = {t, t + 10, t + 20};
    const std::uint64_t ends[] = {t + 30, t + 40, t + 115};
    for (int i = 0; i < 3; ++i) {
      scripts[i].Wait(begins[i], ends[i], kBarrierSync, Data(5, 3));
    }
  }
  macrotask::TraceBuffer two = scripts[1].Buffer();
  two.num_lost = std::erase_if(
      two.records, [&](const auto& record) { return record.clock < from; });
  return HistoryOf({scripts[0].Buffer(), two, scripts[2].Buffer()},
                   1000 + 100 * num_phases);
}

TEST(FindPhases, CompleteTraceHasThemAll) {
  const BarrierPhases phases = FindPhases(PhasesFrom(0, 5));
  ASSERT_EQ(phases.complete.size(), 5u);
  EXPECT_TRUE(phases.skipped.empty());
}

// Wherever the records of a task begin.
TEST(FindPhases, WithLostArrivalsAreSkipped) {
  for (std::uint64_t from = 1011; from < 1500; ++from) {
    const TraceHistory history = PhasesFrom(from, 8);
    const BarrierPhases phases = FindPhases(history);
    for (const BarrierPhase& phase : phases.complete) {
      EXPECT_EQ(phase.last_task, 3u) << from;
      EXPECT_EQ(phase.last % 100, 20u) << from;
      EXPECT_EQ(phase.second_to_last, phase.last - 10) << from;
    }
    const std::uint64_t known = 8 - (history.complete_from - 1000 + 99) / 100;
    EXPECT_EQ(phases.complete.size(), known) << from;
    EXPECT_EQ(phases.skipped.at(5) % 3, (24 - (from - 1011) / 100 - 1) % 3)
        << from;
  }
}

TEST(FindPhases, ThatCannotBeToldApartAreSkipped) {
  Script one(1), two(2);
  // Each leaves only after the other has arrived again.
  for (std::uint64_t t = 1000; t < 1060; t += 20) {
    one.Wait(t, t + 19, kBarrierSync, Data(5, 2));
    two.Wait(t + 10, t + 29, kBarrierSync, Data(5, 2));
  }
  one.At(1060, kBarrierSync, Data(5, 2));
  EXPECT_EQ(FindPhases(HistoryOf({one.Buffer(), two.Buffer()})).complete.size(),
            3u);
  const BarrierPhases lost =
      FindPhases(HistoryOf({one.Buffer(1), two.Buffer()}));
  EXPECT_TRUE(lost.complete.empty());
  EXPECT_EQ(lost.skipped, (Skipped{{5, 7}}));
}

TEST(FindPhases, TasksThatWaitAtTheEndAreOfNoPhase) {
  Script one(1), two(2);
  one.Wait(1010, 1020, kBarrierSync, Data(5, 2))
      .Wait(1030, 1040, kBarrierSync, Data(5, 2))
      .At(1050, kBarrierSync, Data(5, 2));
  two.At(1020, kBarrierSyncEnd, Data(5))
      .Wait(1035, 1040, kBarrierSync, Data(5, 2));
  const BarrierPhases phases =
      FindPhases(HistoryOf({one.Buffer(), two.Buffer(1)}));
  EXPECT_EQ(phases.complete, (Phases{{5, 2, 1035, 1030, 2}}));
  EXPECT_EQ(phases.skipped, (Skipped{{5, 1}}));
}

TEST(FindPhases, RecordingMayBeginWithTasksInTheBarrier) {
  Script one(1), two(2), three(3);
  one.At(1005, kBarrierSyncEnd, Data(5))
      .Wait(1010, 1030, kBarrierSync, Data(5, 3))
      .Wait(1060, 1071, kBarrierSync, Data(5, 3));
  two.At(1012, kBarrierSyncEnd, Data(5))  // after task 1 has arrived again
      .Wait(1020, 1030, kBarrierSync, Data(5, 3))
      .Wait(1050, 1071, kBarrierSync, Data(5, 3));
  three
      .At(1030, kBarrierSyncEnd, Data(5))  // of the next phase
      .Wait(1070, 1071, kBarrierSync, Data(5, 3));
  const BarrierPhases phases =
      FindPhases(HistoryOf({one.Buffer(), two.Buffer(), three.Buffer()}));
  EXPECT_EQ(phases.complete, (Phases{{5, 3, 1070, 1060, 3}}));
  EXPECT_EQ(phases.skipped, (Skipped{{5, 2}}));
}

TEST(FindPhases, AssigningABarrierAnewBeginsAnew) {
  Script one(1), two(2);
  one.At(1010, kBarrierSync, Data(5, 3))
      .At(1020, kBarrierAssign, Data(5, 2))
      .Wait(1030, 1041, kBarrierSync, Data(5, 2));
  two.Wait(1040, 1041, kBarrierSync, Data(5, 2));
  EXPECT_EQ(FindPhases(HistoryOf({one.Buffer(), two.Buffer()})).complete,
            (Phases{{5, 2, 1040, 1030, 2}}));
}

}  // namespace
}  // namespace bench
