#include "bench/sync_latency.h"

#include <gtest/gtest.h>

#include <cmath>

namespace bench {
namespace {

// Ticks, so that hand-made marks do not depend on the speed of the clock.
std::vector<long> InTicks(const std::vector<double>& seconds) {
  std::vector<long> ticks;
  for (const double s : seconds) {
    ticks.push_back(std::lround(s * TicksPerSecond()));
  }
  return ticks;
}

using Expected = std::vector<long>;

TEST(BarrierLatency, IsFromTheLastArrivalToTheLastDeparture) {
  const std::vector<TaskMarks> tasks = {
      {.in = {1000, 5000}, .out = {3100, 6050}, .release = {}},
      {.in = {3000, 6000}, .out = {3050, 6400}, .release = {}}};
  const Latencies latencies = CalcLatencies(LatencyKind::kLastInLastOut, tasks);
  EXPECT_EQ(InTicks(latencies.last), (Expected{100, 400}));
  EXPECT_TRUE(latencies.first.empty());
}

TEST(BarrierLatency, LeavesOutCallsThatNotAllHaveMade) {
  const std::vector<TaskMarks> tasks = {
      {.in = {10, 20}, .out = {15, 25}, .release = {}},
      {.in = {12}, .out = {16}, .release = {}}};
  EXPECT_EQ(InTicks(CalcLatencies(LatencyKind::kLastInLastOut, tasks).last),
            (Expected{4}));
}

TEST(PostLatency, IsToTheFirstAndToTheLastWaiter) {
  const std::vector<TaskMarks> tasks = {
      {.in = {100, 200}, .out = {}, .release = {}},
      {.in = {}, .out = {150, 290}, .release = {}},
      {.in = {}, .out = {130, 295}, .release = {}}};
  const Latencies latencies = CalcLatencies(LatencyKind::kFromFirstTask, tasks);
  EXPECT_EQ(InTicks(latencies.first), (Expected{30, 90}));
  EXPECT_EQ(InTicks(latencies.last), (Expected{50, 95}));
}

TEST(PostLatency, HasNoFirstWithOneWaiter) {
  const std::vector<TaskMarks> tasks = {
      {.in = {100}, .out = {}, .release = {}},
      {.in = {}, .out = {107}, .release = {}}};
  const Latencies latencies = CalcLatencies(LatencyKind::kFromFirstTask, tasks);
  EXPECT_TRUE(latencies.first.empty());
  EXPECT_EQ(InTicks(latencies.last), (Expected{7}));
}

// A clock that is behind makes a latency negative and not huge.
TEST(PostLatency, MayBeNegative) {
  const std::vector<TaskMarks> tasks = {{.in = {100}, .out = {}, .release = {}},
                                        {.in = {}, .out = {98}, .release = {}}};
  EXPECT_EQ(InTicks(CalcLatencies(LatencyKind::kFromFirstTask, tasks).last),
            (Expected{-2}));
}

TEST(HandOff, CountsOnlyFromOneTaskToAnotherThatWaits) {
  const std::vector<TaskMarks> tasks = {
      // Twice in a row, then after a time in which nobody asked.
      {.in = {10, 30, 200}, .out = {11, 31, 201}, .release = {20, 40, 210}},
      // Asked at 25, while task 0 had it at 31 .. 40.
      {.in = {25}, .out = {47}, .release = {60}}};
  EXPECT_EQ(InTicks(CalcHandOffs(tasks)), (Expected{7}));
}

TEST(Whole, IsFromInToReleaseOfTheFirstTask) {
  const std::vector<TaskMarks> tasks = {
      {.in = {5, 100}, .out = {}, .release = {9, 150}},
      {.in = {}, .out = {7, 120}, .release = {}}};
  EXPECT_EQ(InTicks(CalcWholes(tasks)), (Expected{4, 50}));
}

TEST(Latency, IsEmptyForAConstructWithoutOne) {
  EXPECT_TRUE(CalcLatencies(LatencyKind::kNone, {}).last.empty());
}

}  // namespace
}  // namespace bench
