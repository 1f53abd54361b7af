#include "bench/breakdown.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <vector>

#include "bench/breakdown_run.h"
#include "tests/bench/trace_example.h"

namespace bench {
namespace {

using enum macrotask::TraceAction;
using enum Construct;
using integrators::Figure;
using Constructs = std::vector<Construct>;

constexpr auto kBegin = static_cast<Action>(macrotask::kFirstUserAction);
constexpr auto kEnd = static_cast<Action>(macrotask::kFirstUserAction + 1);

const Waiting& At(const TaskBreakdown& task, Construct construct) {
  return task.waiting[static_cast<std::size_t>(construct)];
}

// Of the last run in these buffers.
std::vector<TaskBreakdown> Of(std::vector<macrotask::TraceBuffer> buffers,
                              const Constructs& constructs) {
  const int num_tasks = static_cast<int>(buffers.size());
  return BreakDown(RecordsOfLastRun(TraceOf(std::move(buffers)), num_tasks),
                   constructs);
}

TEST(ConstructsOf, AreThoseWhereTasksOfTheFigureWaitForEachOther) {
  EXPECT_EQ(ConstructsOf(Figure::kSerial, {}), Constructs());
  EXPECT_EQ(ConstructsOf(Figure::kFigure2, {.chain_tasks = 2}),
            (Constructs{kAllTasks, kChains, kEvent}));
  EXPECT_EQ(ConstructsOf(Figure::kFigure3, {.chain_tasks = 4}),
            (Constructs{kAllTasks, kChains}));
  EXPECT_EQ(ConstructsOf(Figure::kFigure7, {.integration_tasks = 2}),
            (Constructs{kAllTasks, kPoints, kEvent}));
  EXPECT_EQ(ConstructsOf(Figure::kFigure8,
                         {.chain_tasks = 2, .integration_tasks = 2}),
            (Constructs{kAllTasks, kChains, kPoints, kEvent}));
  EXPECT_EQ(ConstructsOf(Figure::kFigure8, {.chain_tasks = 2}),
            (Constructs{kAllTasks, kChains}));
  EXPECT_EQ(ConstructsOf(Figure::kFigure8, {}), Constructs());
}

TEST(BreakDown, OneTaskOnlyComputes) {
  Script one(1);
  one.At(1000, kBegin, 0)
      .Wait(1020, 1022, kBarrierSync, Data(5, 1))
      .At(1030, kEventPost, Data(1))
      .At(1090, kEnd, 0);
  const auto tasks = Of({one.Buffer()}, {});
  ASSERT_EQ(tasks.size(), 1u);
  EXPECT_EQ(tasks[0], (TaskBreakdown{90, {}}));
}

TEST(BreakDown, LastToArriveHasNoImbalance) {
  Script one(1), two(2);
  one.At(1000, kBegin, 0)
      .Wait(1010, 1033, kBarrierSync, Data(5, 2))
      .At(1040, kEnd, 0);
  two.At(1000, kBegin, 1)
      .Wait(1030, 1031, kBarrierSync, Data(5, 2))
      .At(1040, kEnd, 1);
  const auto tasks = Of({one.Buffer(), two.Buffer()}, {kAllTasks});
  EXPECT_EQ(At(tasks[0], kAllTasks), (Waiting{20, 3}));
  EXPECT_EQ(tasks[0].compute, 17u);
  EXPECT_EQ(At(tasks[1], kAllTasks), (Waiting{0, 1}));
  EXPECT_EQ(tasks[1].compute, 39u);
}

// Task 2 arrives for the second phase by a clock that is behind: earlier, as it
// seems, than task 1 for the first.
TEST(BreakDown, PhasesAreFoundWithoutTheClocks) {
  Script one(1), two(2);
  one.At(1000, kBegin, 0)
      .Wait(1020, 1021, kBarrierSync, Data(5, 2))
      .Wait(1030, 1031, kBarrierSync, Data(5, 2))
      .At(1040, kEnd, 0);
  two.At(1000, kBegin, 1)
      .Wait(1010, 1012, kBarrierSync, Data(5, 2))
      .Wait(1015, 1031, kBarrierSync, Data(5, 2))
      .At(1040, kEnd, 1);
  const auto tasks = Of({one.Buffer(), two.Buffer()}, {kAllTasks});
  EXPECT_EQ(At(tasks[0], kAllTasks), (Waiting{0, 2}));
  EXPECT_EQ(At(tasks[1], kAllTasks), (Waiting{2 + 15, 1}));
  EXPECT_EQ(tasks[1].total(), 40u);
}

TEST(BreakDown, EventThatWasPostedBeforeIsNoImbalance) {
  Script one(1), two(2), three(3);
  one.At(1000, kBegin, 0)
      .At(1020, kEventPost, Data(7))
      .At(1050, kEventPost, Data(7))
      .At(1060, kEnd, 0);
  two.At(1000, kBegin, 1)
      .Wait(1010, 1024, kEventWait, Data(7))
      .Wait(1045, 1051, kEventWait, Data(7))
      .At(1060, kEnd, 1);
  three.At(1000, kBegin, 2)
      .Wait(1030, 1032, kEventWait, Data(7))
      .Wait(1055, 1055, kEventWait, Data(7))
      .At(1060, kEnd, 2);
  const auto tasks =
      Of({one.Buffer(), two.Buffer(), three.Buffer()}, {kAllTasks});
  EXPECT_EQ(tasks[0], (TaskBreakdown{60, {}}));
  EXPECT_EQ(At(tasks[1], kEvent), (Waiting{10 + 5, 4 + 1}));
  EXPECT_EQ(At(tasks[2], kEvent), (Waiting{0, 2}));
}

// Tasks (1, 1), (1, 2), (2, 1), (2, 2) of Figure 8, one block each: barrier 9
// of all, 1 and 2 of chains, 3 and 4 of points, an event for each chain.
TEST(BreakDown, TellsTheBarriersOfAFigureApart) {
  std::vector<macrotask::TraceBuffer> buffers;
  for (std::uint32_t task = 0; task < 4; ++task) {
    const std::uint32_t i = task / 2, k = task % 2;
    Script script(task + 1);
    script.At(1000, kBegin, task)
        .Wait(1002 + task, 1006, kBarrierSync, Data(9, 4))
        .Wait(1010 + task, 1015, kBarrierSync, Data(1 + i, 2))
        .Wait(1020 + task, 1026, kBarrierSync, Data(3 + k, 2));
    if (i == 0) {
      script.At(1030, kEventClear, Data(1 + k))
          .At(1035, kEventPost, Data(1 + k));
    } else {
      script.Wait(1031, 1037, kEventWait, Data(1 + k));
    }
    script.Wait(1050, 1051, kBarrierSync, Data(9, 4)).At(1060, kEnd, task);
    buffers.push_back(script.Buffer());
  }
  const auto tasks = Of(buffers, ConstructsOf(Figure::kFigure8, {2, 2}));
  EXPECT_EQ(At(tasks[0], kAllTasks), (Waiting{3, 1 + 1}));
  EXPECT_EQ(At(tasks[0], kChains), (Waiting{1, 4}));
  EXPECT_EQ(At(tasks[0], kPoints), (Waiting{2, 4}));
  EXPECT_EQ(At(tasks[0], kEvent), (Waiting{0, 0}));
  EXPECT_EQ(At(tasks[3], kChains), (Waiting{0, 2}));
  EXPECT_EQ(At(tasks[3], kPoints), (Waiting{0, 3}));
  EXPECT_EQ(At(tasks[3], kEvent), (Waiting{4, 2}));
  for (const TaskBreakdown& task : tasks) EXPECT_EQ(task.total(), 60u);
}

TEST(BreakDown, CountsTheTimeOfTheFirstTask) {
  Script one(1), early(2), late(3);
  one.At(1020, kBegin, 0)
      .Wait(1050, 1060, kBarrierSync, Data(5, 3))
      .At(1080, kEnd, 0);
  early.At(1010, kBegin, 1)
      .Wait(1015, 1061, kBarrierSync, Data(5, 3))
      .At(1070, kEnd, 1);
  late.At(1030, kBegin, 2)
      .Wait(1058, 1062, kBarrierSync, Data(5, 3))
      .At(1090, kEnd, 2);
  const auto tasks =
      Of({one.Buffer(), early.Buffer(), late.Buffer()}, {kAllTasks});
  EXPECT_EQ(At(tasks[1], kAllTasks), (Waiting{38, 3}));
  EXPECT_EQ(tasks[1].total(), 50u);
  EXPECT_EQ(At(tasks[2], kAllTasks), (Waiting{0, 10 + 4}));
  EXPECT_EQ(tasks[2].total(), 60u);
}

TEST(RecordsOfLastRun, AreByTaskWhateverTheirNumbers) {
  Script one(1), two(7);
  one.At(1000, kBegin, 0)
      .At(1010, kEventPost, Data(1))
      .At(1020, kEnd, 0)
      .At(1021, kBarrierSync, Data(1, 2))
      .At(1030, kBegin, 1)
      .At(1040, kEnd, 1);
  two.At(1005, kBegin, 1)
      .At(1020, kEnd, 1)
      .At(1031, kBegin, 0)
      .At(1035, kEventPost, Data(2))
      .At(1040, kEnd, 0);
  const RunRecords run =
      RecordsOfLastRun(TraceOf({one.Buffer(3), two.Buffer()}), 2);
  ASSERT_EQ(run.size(), 2u);
  EXPECT_EQ(run[0].size(), 3u);
  EXPECT_EQ(run[0].front().task, 7u);
  EXPECT_EQ(run[1].size(), 2u);
  EXPECT_EQ(run[1].front().clock, 1030u);
}

TEST(RecordsOfLastRun, MustAllBeThere) {
  Script one(1);
  one.At(1000, kBegin, 0);
  const auto trace = TraceOf({one.Buffer()});
  EXPECT_THROW(RecordsOfLastRun(trace, 1), std::runtime_error);  // no end
  one.At(1010, kEnd, 0);
  EXPECT_NO_THROW(RecordsOfLastRun(TraceOf({one.Buffer()}), 1));
  EXPECT_THROW(RecordsOfLastRun(TraceOf({one.Buffer()}), 2),
               std::runtime_error);
}

TEST(MiddleHalf, DropsTheFastestAndTheSlowestQuarter) {
  std::vector<TracedRun> runs;
  for (const double seconds : {9.0, 1.0, 4.0, 3.0, 5.0}) {
    runs.push_back({seconds, {}});
  }
  const auto middle = MiddleHalf(runs);
  ASSERT_EQ(middle.size(), 3u);
  EXPECT_EQ(middle[0].seconds, 3);
  EXPECT_EQ(middle[2].seconds, 5);
  EXPECT_EQ(MiddleHalf({runs[0]}).size(), 1u);
}

// Two tasks, two runs; one tick is a microsecond.
TEST(BreakdownText, HasMeansThatAddUp) {
  MeasuredBreakdown measured;
  measured.options.figure = Figure::kFigure3;
  measured.options.partition = {.chain_tasks = 2};
  measured.ticks_per_second = 1e6;
  for (const std::uint64_t more : {0u, 10u}) {
    TracedRun run{static_cast<double>(more + 101) * 1e-6, {{}, {}}};
    run.tasks[0].compute = 100 + more;
    run.tasks[1].compute = 60;
    run.tasks[1].waiting[static_cast<std::size_t>(kChains)] = {30 + more, 10};
    measured.traced.push_back(run);
    measured.untraced_seconds.push_back(100e-6);
  }
  const std::string text = BreakdownText(measured);
  EXPECT_NE(text.find("| 1 (1, 1) | 106.00 | 105.00  | 0.00 "),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("| 35.00                 | 10.00 | 105.00 | 1.00     |"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("disturbance: 6.0 % [1.0, 11.0]"), std::string::npos)
      << text;
  EXPECT_EQ(text.find("EVWAIT"), std::string::npos) << text;
}

}  // namespace
}  // namespace bench
