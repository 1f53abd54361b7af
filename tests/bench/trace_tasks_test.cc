#include "bench/trace_tasks.h"

#include <gtest/gtest.h>

#include <map>
#include <string>

#include "tests/bench/trace_example.h"

namespace bench {
namespace {

using enum macrotask::TraceAction;
using Ticks = std::vector<std::uint64_t>;

std::map<std::uint32_t, std::string> StateTexts(const TraceHistory& history) {
  std::map<std::uint32_t, std::string> texts;
  for (const TaskStatus& status : StatesAtEnd(history)) {
    texts[status.task] = StateText(status) + " " + std::to_string(status.since);
  }
  return texts;
}

TEST(TaskSpans, EndWithTheBodyOrTheTrace) {
  Script one(1), two(2), three(3);
  one.At(1001, kEventPost, Data(1));
  two.At(1010, kTaskBegin).At(1020, kTaskEnd);
  three.At(1030, kTaskBegin).At(1040, kEventPost, Data(1));
  // The second and the third task ran on the same pthread.
  macrotask::TraceBuffer pthread = two.Buffer();
  const auto more = three.Buffer().records;
  pthread.records.insert(pthread.records.end(), more.begin(), more.end());
  EXPECT_EQ(HistoryOf({one.Buffer(), pthread}).spans,
            (std::vector<TaskSpan>{{1, 1001, 1100, false, false},
                                   {2, 1010, 1020, true, true},
                                   {3, 1030, 1100, true, false}}));
}

TEST(TaskSpans, EndWhereTheNextTaskOfThePthreadBegins) {
  Script two(2), three(3);
  two.At(1010, kEventPost, Data(1)).At(1020, kEventPost, Data(1));
  three.At(1030, kTaskBegin);
  macrotask::TraceBuffer pthread = two.Buffer();
  pthread.records.push_back(three.Buffer().records[0]);
  EXPECT_EQ(HistoryOf({pthread}).spans,
            (std::vector<TaskSpan>{{2, 1010, 1020, false, true},
                                   {3, 1030, 1100, true, false}}));
}

TEST(TaskSpans, EndWithTheLastRecordWhereEndsAreNotRecorded) {
  macrotask::Trace trace =
      TraceOf({Script(1).At(1010, kEventPost).At(1020, kEventPost).Buffer()});
  trace.classes = 4;  // EVENTS
  EXPECT_EQ(MakeHistory(trace).spans,
            (std::vector<TaskSpan>{{1, 1010, 1020, false, false}}));
}

TEST(RunningPieces, AreBodiesWithoutWaitsByProcessor) {
  Script two(2, 0);
  two.At(1010, kTaskBegin)
      .At(1020, kEventPost, Data(1))
      .At(1030, kBarrierSync, Data(3, 2))
      .At(1031, kSleep)
      .MoveTo(1)
      .At(1039, kWake)
      .At(1040, kBarrierSyncEnd, Data(3))
      .At(1050, kEventPost, Data(1))
      .MoveTo(0)
      .At(1060, kEventPost, Data(1))
      .At(1070, kTaskEnd);
  EXPECT_EQ(RunningPieces(HistoryOf({two.Buffer()})),
            (std::vector<RunningPiece>{
                {2, 0, 1010, 1030}, {2, 1, 1040, 1060}, {2, 0, 1060, 1070}}));
}

TEST(RunningPieces, OfTheExampleAddUpToItsKnownTimes) {
  std::map<std::uint32_t, std::uint64_t> ticks;
  for (const auto& piece : RunningPieces(MakeHistory(ExampleTrace()))) {
    ticks[piece.task] += piece.end - piece.begin;
  }
  EXPECT_EQ(ticks[1], 55u);
  EXPECT_EQ(ticks[2], 80u);
}

TEST(TicksAtConcurrency, CountsHowManyRunAtOnce) {
  const std::vector<RunningPiece> pieces = {
      {1, 0, 10, 40}, {2, 1, 20, 50}, {3, 0, 30, 35}, {3, 0, 40, 45}};
  // 0: 0-10, 50-60; 1: 10-20, 45-50; 2: 20-30, 35-40, 40-45; 3: 30-35.
  EXPECT_EQ(TicksAtConcurrency(pieces, 0, 60), (Ticks{20, 15, 20, 5}));
  EXPECT_DOUBLE_EQ(MeanConcurrency({20, 15, 20, 5}), 70.0 / 60.0);
}

TEST(TicksAtConcurrency, LooksOnlyBetweenItsBounds) {
  const std::vector<RunningPiece> pieces = {{1, 0, 10, 40}, {2, 1, 20, 50}};
  EXPECT_EQ(TicksAtConcurrency(pieces, 30, 45), (Ticks{0, 5, 10}));
  EXPECT_EQ(TicksAtConcurrency(pieces, 60, 70), Ticks{10});
  EXPECT_EQ(TicksAtConcurrency({}, 5, 5), Ticks{0});
  EXPECT_EQ(MeanConcurrency({0}), 0);
}

TEST(StatesAtEnd, AreRunningWaitingSleepingCompleteOrReady) {
  Script one(1), two(2), three(3), four(4), five(5);
  one.At(1001, kTaskStart, Data(2))
      .At(1002, kTaskStart, Data(9))
      .Wait(1010, 1020, kLockOn, Data(1));
  two.At(1010, kTaskBegin).At(1020, kTaskEnd);
  three.At(1010, kTaskBegin).At(1030, kBarrierSync, Data(7, 2));
  four.At(1010, kTaskBegin).At(1040, kEventWait, Data(8)).At(1041, kSleep);
  five.At(1010, kTaskBegin).At(1050, kSleep);
  const TraceHistory history =
      HistoryOf({one.Buffer(), two.Buffer(), three.Buffer(), four.Buffer(),
                 five.Buffer()});
  EXPECT_EQ(StateTexts(history), (std::map<std::uint32_t, std::string>{
                                     {1, "running 1020"},
                                     {2, "complete 1020"},
                                     {3, "waiting for barrier 7 1030"},
                                     {4, "waiting for event 8, asleep 1040"},
                                     {5, "sleeping 1050"},
                                     {9, "ready 1002"}}));
}

TEST(StatesAtEnd, TaskWithoutRecordsIsUnknownWhereRecordsWereLost) {
  Script one(1), two(2);
  one.At(1001, kTaskStart, Data(9));
  two.At(1090, kEventPost, Data(1));
  EXPECT_EQ(StateTexts(HistoryOf({one.Buffer(), two.Buffer(100)})).at(9),
            "records lost 1001");
}

TEST(MakeHistory, EmptyTraceHasNoTasks) {
  const TraceHistory history = MakeHistory(macrotask::Trace());
  EXPECT_TRUE(history.spans.empty());
  EXPECT_TRUE(StatesAtEnd(history).empty());
  EXPECT_EQ(history.begin, history.end);
}

TEST(MakeHistory, RecordsOutsideOfItsClocksExtendTheTrace) {
  Script one(1);
  one.At(990, kEventPost, Data(1)).At(1110, kEventPost, Data(1));
  const TraceHistory history = HistoryOf({one.Buffer()});
  EXPECT_EQ(history.begin, 990u);
  EXPECT_EQ(history.end, 1110u);
}

}  // namespace
}  // namespace bench
