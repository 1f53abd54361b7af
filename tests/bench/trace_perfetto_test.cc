#include "bench/trace_perfetto.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/bench/trace_example.h"

namespace bench {
namespace {

using enum macrotask::TraceAction;
using nlohmann::json;

std::vector<json> Events(const TraceHistory& history,
                         const std::string& phase) {
  const json document = json::parse(PerfettoJson(history));
  std::vector<json> events;
  for (const json& event : document.at("traceEvents")) {
    if (event.at("ph") == phase) events.push_back(event);
  }
  return events;
}

// What is called `name`, as "task begin duration".
std::vector<std::string> SpansCalled(const TraceHistory& history,
                                     const std::string& name) {
  std::vector<std::string> spans;
  for (const json& event : Events(history, "X")) {
    if (event.at("name") != name) continue;
    spans.push_back(event.at("tid").dump() + " " + event.at("ts").dump() + " " +
                    event.at("dur").dump());
  }
  return spans;
}

// Spans of one row lie beside or inside each other.
void ExpectBalanced(const TraceHistory& history) {
  struct Span {
    double begin, end;
  };
  std::map<int, std::vector<Span>> rows;
  for (const json& event : Events(history, "X")) {
    const double begin = event.at("ts"), duration = event.at("dur");
    EXPECT_GE(begin, 0);
    EXPECT_GE(duration, 0);
    rows[event.at("tid")].push_back({begin, begin + duration});
  }
  constexpr double kRounding = 1e-6;  // far below a nanosecond, in us
  for (const auto& [task, spans] : rows) {
    for (const Span& a : spans) {
      for (const Span& b : spans) {
        const bool beside =
            a.end <= b.begin + kRounding || b.end <= a.begin + kRounding;
        const bool inside =
            (a.begin >= b.begin && a.end <= b.end + kRounding) ||
            (b.begin >= a.begin && b.end <= a.end + kRounding);
        EXPECT_TRUE(beside || inside)
            << task << ": " << a.begin << " to " << a.end << " and " << b.begin
            << " to " << b.end;
      }
    }
  }
}

TEST(PerfettoJson, TasksAreRowsWithTheirUserValuesAsNames) {
  std::map<int, std::string> names;
  for (const json& event : Events(MakeHistory(ExampleTrace()), "M")) {
    if (event.at("name") != "thread_name") continue;
    names[event.at("tid")] = event.at("args").at("name");
  }
  EXPECT_EQ(names, (std::map<int, std::string>{{1, "task 1"},
                                               {2, "task 2 (ARM  \"1\")"}}));
}

TEST(PerfettoJson, WaitsAreSpansInsideOfTheirTasks) {
  const TraceHistory history = MakeHistory(ExampleTrace());
  using Spans = std::vector<std::string>;
  EXPECT_EQ(SpansCalled(history, "task 1"), Spans{"1 0.0 100.0"});
  EXPECT_EQ(SpansCalled(history, "task 2 (ARM  \"1\")"), Spans{"2 10.0 87.0"});
  EXPECT_EQ(SpansCalled(history, "BARSYNC barrier 3"),
            (Spans{"1 20.0 10.0", "2 29.0 1.0", "2 45.0 6.0", "1 50.0 1.0"}));
  EXPECT_EQ(SpansCalled(history, "TSKWAIT task 2"), Spans{"1 85.0 15.0"});
  EXPECT_EQ(Events(history, "X").size(), 2u + 8u);
  ExpectBalanced(history);
}

TEST(PerfettoJson, AllElseIsAnInstant) {
  std::vector<std::string> names;
  for (const json& event : Events(MakeHistory(ExampleTrace()), "i")) {
    EXPECT_EQ(event.at("s"), "t");
    names.push_back(event.at("name"));
  }
  EXPECT_EQ(names, (std::vector<std::string>{
                       "BUFTUNE", "BARASGN barrier 3", "TSKSTART task 2",
                       "EVPOST event 1", "EVCLEAR event 1", "LOCKOFF lock 4",
                       "LOCKOFF lock 4", "user 70"}));
}

TEST(PerfettoJson, ArrowGoesFromThePostIntoTheWaitItEnded) {
  const TraceHistory history = MakeHistory(ExampleTrace());
  const auto begins = Events(history, "s"), ends = Events(history, "f");
  ASSERT_EQ(begins.size(), 1u);
  ASSERT_EQ(ends.size(), 1u);
  EXPECT_EQ(begins[0].at("id"), ends[0].at("id"));
  EXPECT_EQ(begins[0].at("tid"), 2);
  EXPECT_EQ(begins[0].at("ts"), 60.0);
  EXPECT_EQ(ends[0].at("tid"), 1);
  EXPECT_EQ(ends[0].at("ts"), 64.999);
}

TEST(PerfettoJson, UnfinishedWaitLastsToTheEndAndLostBeginningIsSkipped) {
  Script one(1);
  one.At(1010, kLockOnEnd, Data(1))
      .At(1020, kEventWait, Data(1))
      .At(1030, kSleep);
  const TraceHistory history = HistoryOf({one.Buffer(5)});
  using Spans = std::vector<std::string>;
  EXPECT_EQ(SpansCalled(history, "EVWAIT event 1"), Spans{"1 20.0 80.0"});
  EXPECT_EQ(SpansCalled(history, "sleeps"), Spans{"1 30.0 70.0"});
  EXPECT_EQ(Events(history, "X").size(), 3u);
  ExpectBalanced(history);
}

// 0.4 ns a tick: no clock is a whole nanosecond.
TEST(PerfettoJson, RoundingKeepsSpansInsideEachOther) {
  Script one(1);
  one.At(999, kTaskBegin);
  for (std::uint64_t t = 1000; t < 1200; t += 7) {
    one.At(t, kBarrierSync, Data(3, 2))
        .At(t + 1, kSleep)
        .At(t + 5, kWake)
        .At(t + 6, kBarrierSyncEnd, Data(3));
  }
  one.At(1206, kTaskEnd);
  macrotask::Trace trace = TraceOf({one.Buffer()}, 1300);
  trace.ticks_per_second = 2.5e9;
  const TraceHistory history = MakeHistory(trace);
  ExpectBalanced(history);
  EXPECT_EQ(SpansCalled(history, "task 1")[0], "1 0.0 0.082");
}

TEST(PerfettoJson, EmptyTraceIsADocument) {
  const json document = json::parse(PerfettoJson(TraceHistory()));
  EXPECT_TRUE(document.at("traceEvents").is_array());
}

}  // namespace
}  // namespace bench
