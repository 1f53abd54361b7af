#include "macrotask/trace_text.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

namespace macrotask {
namespace {

using enum TraceAction;

TraceRecord Record(TraceAction action, std::uint64_t data,
                   std::uint64_t clock = 0, std::uint32_t task = 1) {
  return {clock, data, task, 0, action};
}

std::uint64_t Data(std::uint32_t object, std::uint32_t detail) {
  return std::uint64_t{detail} << 32 | object;
}

TEST(InOrderOfTimeTest, MergesTheBuffersAndKeepsTheirOrderAtTheSameTime) {
  Trace trace;
  trace.buffers.resize(3);
  trace.buffers[0].records = {Record(kLockOn, 0, 10), Record(kLockOn, 1, 30),
                              Record(kLockOn, 2, 30)};
  trace.buffers[2].records = {Record(kLockOn, 3, 5), Record(kLockOn, 4, 30),
                              Record(kLockOn, 5, 31)};
  std::vector<std::uint64_t> order;
  for (const auto& record : InOrderOfTime(trace)) order.push_back(record.data);
  EXPECT_EQ(order, (std::vector<std::uint64_t>{3, 0, 1, 2, 4, 5}));
}

TEST(InOrderOfTimeTest, IsEmptyForAnEmptyTrace) {
  EXPECT_TRUE(InOrderOfTime(Trace()).empty());
}

TEST(ActionTextTest, IsCraysNameOrTheNumber) {
  EXPECT_EQ(ActionText(kBarrierSync), "BARSYNC");
  EXPECT_EQ(ActionText(TraceAction{65}), "user 65");
  EXPECT_EQ(ActionText(TraceAction{128}), "user 128");
  EXPECT_EQ(ActionText(TraceAction{64}), "action 64");
  EXPECT_EQ(ActionText(TraceAction{999}), "action 999");
}

// Eight characters as a user value.
constexpr std::uint64_t ValueOf(const char (&text)[9]) {
  std::uint64_t value = 0;
  for (int i = 7; i >= 0; --i) {
    value = value << 8 | static_cast<unsigned char>(text[i]);
  }
  return value;
}

std::string Detail(TraceAction action, std::uint64_t data) {
  return DetailText(Record(action, data));
}

TEST(ValueTextTest, ShowsEightPrintableCharactersAsText) {
  EXPECT_EQ(ValueText(ValueOf("ARM 1   ")), "ARM 1");
  EXPECT_EQ(ValueText(ValueOf("a~\"b\\ 'c")), "a~\"b\\ 'c");
  EXPECT_EQ(ValueText(ValueOf("        ")), "");
}

TEST(ValueTextTest, ShowsOtherNumbersAsHexadecimal) {
  EXPECT_EQ(ValueText(0), "");
  EXPECT_EQ(ValueText(65), "0x41");
  EXPECT_EQ(ValueText(ValueOf("ARM 123\x7f")), "0x7f333231204d5241");
  EXPECT_EQ(ValueText(~std::uint64_t{0}), "0xffffffffffffffff");
}

TEST(ObjectTextTest, SaysKindAndNumber) {
  const auto text = [](TraceAction action, std::uint64_t data) {
    return ObjectText(ObjectOf({0, data, 1, 0, action}));
  };
  EXPECT_EQ(text(kBarrierSyncEnd, Data(3, 4)), "barrier 3");
  EXPECT_EQ(text(kEventTestClear, Data(3, 4)), "event 3");
  EXPECT_EQ(text(kLockTestOn, 0), "lock 0");
  EXPECT_EQ(text(kTaskStart, 2), "task 2");
  for (const TraceAction action :
       {kTaskBegin, kTaskEnd, kSleep, kTune, TraceAction{65}}) {
    EXPECT_EQ(text(action, 2), "");
  }
}

TEST(DetailTextTest, SaysWhatTheDataWordHolds) {
  EXPECT_EQ(Detail(kBarrierSync, Data(3, 4)), "4 tasks");
  EXPECT_EQ(Detail(kBarrierAssign, Data(3, 1)), "1 task");
  EXPECT_EQ(Detail(kBarrierSyncEnd, 3), "");
  EXPECT_EQ(Detail(kTaskBegin, ValueOf("ARM 1   ")), "ARM 1");
  EXPECT_EQ(Detail(kTaskTest, Data(2, 1)), "not complete");
  EXPECT_EQ(Detail(kTaskTest, Data(2, 0)), "complete");
  EXPECT_EQ(Detail(kLockTestSet, Data(2, 9)), "9 times");
  EXPECT_EQ(Detail(kLockTestSet, Data(2, 1)), "");
  EXPECT_EQ(Detail(kTraceClasses, 5), "TASKS EVENTS");
  EXPECT_EQ(Detail(kTraceClasses, 0), "nothing");
  EXPECT_EQ(Detail(kTune, Data(50, 4)), "HOLDTIME = 50");
  EXPECT_EQ(Detail(kTune, Data(50, 9)), "value 9 = 50");
  EXPECT_EQ(Detail(TraceAction{65}, 255), "0xff");
  EXPECT_EQ(Detail(TraceAction{300}, 255), "0xff");
}

TEST(CallsOfTest, CountsTestsInARowAndNoEndsOfWaits) {
  EXPECT_EQ(CallsOf({0, Data(1, 1000), 1, 0, kEventTest}), 1000u);
  EXPECT_EQ(CallsOf({0, Data(1, 0), 1, 0, kEventTest}), 1u);
  EXPECT_EQ(CallsOf({0, Data(1, 4), 1, 0, kBarrierSync}), 1u);
  EXPECT_EQ(CallsOf({0, Data(1, 4), 1, 0, kBarrierSyncEnd}), 0u);
}

TEST(ToTextTest, HasALineForEachEntry) {
  Trace trace;
  trace.ticks_per_second = 2e9;
  trace.first_clock = 1000;
  trace.buffers.resize(2);
  trace.buffers[0].records = {{1000, 63, 1, 0, kTraceClasses},
                              {2001000, 2, 1, 1, kTaskStart}};
  trace.buffers[1].records = {{4000, Data(3, 4), 12345, 127, kBarrierSync},
                              {4000000, 0x1f, 2, 3, TraceAction{100}}};
  EXPECT_EQ(
      ToText(trace),
      "      time (us)  task  cpu  class   action          data\n"
      "          0.000     1    0  INFO    BUFTUNE         "
      "TASKS LOCKS EVENTS CPUS USERS INFO\n"
      "          1.500 12345  127  EVENTS  BARSYNC         barrier 3, 4 tasks\n"
      "       1000.000     1    1  TASKS   TSKSTART        task 2\n"
      "       1999.500     2    3  USERS   user 100        0x1f\n");
}

TEST(ToTextTest, IsTheHeadingForAnEmptyTrace) {
  EXPECT_EQ(ToText(Trace()),
            "      time (us)  task  cpu  class   action          data\n");
}

}  // namespace
}  // namespace macrotask
