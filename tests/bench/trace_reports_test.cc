#include "bench/trace_reports.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

#include "bench/trace_perfetto.h"
#include "tests/bench/trace_example.h"

namespace bench {
namespace {

using enum macrotask::TraceAction;

// Without the blanks that align a table.
std::string Squeezed(const std::string& text) {
  std::string squeezed;
  for (const char c : text) {
    if (c != ' ' || squeezed.empty() || squeezed.back() != ' ') squeezed += c;
  }
  return squeezed;
}

std::string Text(TraceReport report, const TraceFilter& filter = {},
                 const macrotask::Trace& trace = ExampleTrace()) {
  return Squeezed(TraceReportText(report, MakeHistory(trace), filter));
}

void ExpectLines(const std::string& text,
                 const std::vector<std::string>& lines) {
  for (const std::string& line : lines) {
    EXPECT_NE(text.find("\n" + line + "\n"), std::string::npos)
        << line << "\nis not in\n"
        << text;
  }
}

TEST(TraceHeader, SaysWhenAndHowMuch) {
  EXPECT_EQ(TraceHeader(MakeHistory(ExampleTrace())),
            "begun:      1993-01-01 00:00:00 UTC\n"
            "taken:      100.000 us later\n"
            "records:    26 of 2 tasks\n"
            "lost:       none\n"
            "recorded:   TASKS LOCKS EVENTS CPUS USERS INFO\n"
            "processors: 2\n");
  macrotask::Trace trace = ExampleTrace();
  trace.buffers[1].num_lost = 1000;
  EXPECT_NE(TraceHeader(MakeHistory(trace))
                .find("lost:       1000 overwritten; complete from 10.000 us"),
            std::string::npos);
}

TEST(TotalsReport, AddsUpTimesByTaskAndCountsByAction) {
  ExpectLines(
      Text(TraceReport::kTotals),
      {"| 1 | | 15 | 0 | 0.000 | 100.000 | 55.000 | 11.000 | 10.000 | 9.000 | "
       "15.000 | 0.000 |",
       "| 2 | ARM \"1\" | 11 | 0 | 10.000 | 97.000 | 80.000 | 7.000 | 0.000 | "
       "0.000 | 0.000 | 0.000 |",
       "| EVENTS | BARSYNC | 4 | 4 |", "| EVENTS | BARSYNC end | 4 | |",
       "| USERS | user 70 | 1 | 1 |"});
}

TEST(TotalsReport, SleepIsPartOfAWaitAndTestsInARowAreCalls) {
  Script one(1);
  one.At(1000, kEventTestClear, Data(1, 500))
      .At(1010, kLockOn, Data(1))
      .At(1012, kSleep)
      .At(1018, kWake)
      .At(1020, kLockOnEnd, Data(1))
      .At(1020, kTaskEnd);
  ExpectLines(Text(TraceReport::kTotals, {}, TraceOf({one.Buffer(7)})),
              {"| 1 | | 6 | 7 | 0.000 | 20.000 | 10.000 | 0.000 | 0.000 | "
               "10.000 | 0.000 | 6.000 |",
               "| EVENTS | EVTEST clear | 1 | 500 |",
               "lost: older records, of this task or of earlier ones in the "
               "same buffer; the task"});
}

TEST(ChronReport, HasEveryRecordInTimeOrder) {
  const std::string text = Text(TraceReport::kChron);
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 2 + 2 + 26);
  ExpectLines(text,
              {"| 20.000 | 1 | 0 | EVENTS | BARSYNC | barrier 3 | 2 tasks |",
               "| 29.000 | 2 | 1 | EVENTS | BARSYNC | barrier 3 | 2 tasks |",
               "| 30.000 | 1 | 0 | EVENTS | BARSYNC end | barrier 3 | |",
               "| 81.000 | 2 | 1 | USERS | user 70 | | 0x5 |"});
  EXPECT_LT(text.find("| 29.000"), text.find("| 30.000"));
}

TEST(ChronReport, ShowsWhatTheFilterAdmits) {
  const auto rows = [](const TraceFilter& filter) {
    const std::string text = Text(TraceReport::kChron, filter);
    return std::count(text.begin(), text.end(), '\n') - 4;
  };
  using macrotask::TraceClass;
  EXPECT_EQ(rows({.tasks = {2}}), 11);
  EXPECT_EQ(rows({.tasks = {1, 2}}), 26);
  EXPECT_EQ(rows({.tasks = {3}}), 0);
  EXPECT_EQ(rows({.classes = {TraceClass::kLocks}}), 6);
  EXPECT_EQ(rows({.classes = {TraceClass::kLocks, TraceClass::kUsers}}), 7);
  EXPECT_EQ(rows({.actions = {kBarrierSync}}), 4);
  EXPECT_EQ(rows({.tasks = {1}, .actions = {kBarrierSync, kLockOff}}), 3);
  EXPECT_EQ(rows({.classes = {TraceClass::kLocks}, .actions = {kBarrierSync}}),
            0);
}

TEST(ChronCsv, HasTheDataWordAndQuotesWhatItMust) {
  const std::string csv = ChronCsv(MakeHistory(ExampleTrace()), {.tasks = {2}});
  EXPECT_EQ(csv.substr(0, csv.find("29.000")),
            "time_us,task,cpu,class,action,object,detail,data\n"
            "10.000,2,1,TASKS,task begins,,\"ARM  \"\"1\"\"\"," +
                std::to_string(Value("ARM  \"1\"")) + "\n");
  EXPECT_NE(csv.find("\n29.000,2,1,EVENTS,BARSYNC,barrier 3,2 tasks," +
                     std::to_string(Data(3, 2)) + "\n"),
            std::string::npos);
}

TEST(SyncReport, SaysWhoWaitedAndForWhom) {
  ExpectLines(
      Text(TraceReport::kSync),
      {"| barrier 3 | 5 | 4 | 18.000 | 4.500 | 10.000 | 1 |",
       "| event 1 | 3 | 1 | 10.000 | 10.000 | 10.000 | 1 |",
       "| lock 4 | 4 | 2 | 9.000 | 4.500 | 9.000 | 1 |",
       "| task 2 | 2 | 1 | 15.000 | 15.000 | 15.000 | 1 |",
       // Barrier, phases, last task, how often, held up, longest.
       "| 3 | 2 | 1 | 1 | 5.000 | 5.000 |", "| 3 | 2 | 2 | 1 | 9.000 | 9.000 |",
       // Event, poster, posts, waits ended, longest.
       "| 1 | 2 | 1 | 1 | 5.000 |",
       // Lock, holder, times, held, longest, while others wait.
       "| 4 | 1 | 1 | 1.000 | 1.000 | 0.000 |",
       "| 4 | 2 | 1 | 16.000 | 16.000 | 8.000 |"});
}

TEST(SyncReport, FilterChoosesCallsButAllTasksAreSeen) {
  const std::string one = Text(TraceReport::kSync, {.tasks = {1}});
  ExpectLines(one, {"| barrier 3 | 3 | 2 | 11.000 | 5.500 | 10.000 | 1 |",
                    "| 3 | 2 | 1 | 1 | 5.000 | 5.000 |"});
  EXPECT_EQ(one.find("| 3 | 2 | 2 |"), std::string::npos);
  const std::string locks =
      Text(TraceReport::kSync, {.classes = {macrotask::TraceClass::kLocks}});
  ExpectLines(locks, {"| 4 | 2 | 1 | 16.000 | 16.000 | 8.000 |"});
  EXPECT_EQ(locks.find("barrier"), std::string::npos);
}

TEST(SyncReport, SaysWhichArrivalsItSkipped) {
  macrotask::Trace trace = ExampleTrace();
  auto& records = trace.buffers[0].records;
  records.erase(records.begin(), records.begin() + 4);  // first BARSYNC
  trace.buffers[0].num_lost = 4;
  ExpectLines(
      Text(TraceReport::kSync, {}, trace),
      {"| 3 | 1 | 1 | 1 | 5.000 | 5.000 |",
       "barrier 3: 1 arrival skipped, of phases that are not all in the "
       "trace."});
}

TEST(CpuReport, SaysHowManyRanAtOnce) {
  ExpectLines(
      Text(TraceReport::kCpu),
      {"| 0 | 15 | 1 | 55.000 | 55.0 |", "| 1 | 11 | 2 | 80.000 | 80.0 |",
       "| 0 | 5.000 | 5.0 |", "| 1 | 55.000 | 55.0 |", "| 2 | 40.000 | 40.0 |",
       "Average concurrency: 1.35", "| 1 | 0 | 0 |", "| 2 | 0 | 1 |"});
}

TEST(CpuReport, CountsMigrationsAndSharedProcessorsOnce) {
  Script one(1, 0), two(2, 0);
  one.At(1000, kEventPost, Data(1))
      .MoveTo(1)
      .At(1040, kEventPost, Data(1))
      .MoveTo(0)
      .At(1060, kEventPost, Data(1))
      .At(1060, kTaskEnd);
  two.At(1020, kTaskBegin).At(1050, kTaskEnd);
  ExpectLines(
      Text(TraceReport::kCpu, {}, TraceOf({one.Buffer(), two.Buffer()})),
      {"| 0 | 5 | 1 2 | 50.000 | 50.0 |", "| 1 | 1 | 1 | 20.000 | 20.0 |",
       "| 1 | 2 | 0 1 |", "| 2 | 0 | 0 |", "Average concurrency: 0.90"});
}

TEST(CpuReport, BeginsWhereNoRecordWasLost) {
  Script one(1), two(2);
  one.At(1000, kEventPost, Data(1)).At(1100, kEventPost, Data(1));
  two.At(1060, kEventPost, Data(1)).At(1100, kTaskEnd);
  const std::string text =
      Text(TraceReport::kCpu, {}, TraceOf({one.Buffer(), two.Buffer(9)}));
  EXPECT_EQ(text.find("CPU from 60.000 us to 100.000 us."), 0u) << text;
  ExpectLines(text, {"Average concurrency: 2.00"});
}

TEST(StatusReport, ShowsWhoWaitsForWhatSinceWhen) {
  ExpectLines(
      Text(TraceReport::kStatus),
      {"| 1 | | running | 100.000 |", "| 2 | ARM \"1\" | complete | 97.000 |"});
  Script one(1), two(2);
  one.At(1010, kLockOn, Data(1)).At(1011, kSleep);
  two.At(1005, kTaskBegin, 1).At(1020, kTaskWait, Data(1));
  ExpectLines(
      Text(TraceReport::kStatus, {}, TraceOf({one.Buffer(), two.Buffer()})),
      {"| 1 | | waiting for lock 1, asleep | 10.000 |",
       "| 2 | 0x1 | waiting for task 1 | 20.000 |",
       "Every task that is not complete waits."});
}

TEST(TraceReports, TraceWithoutRecordsHasThemAll) {
  const TraceHistory history = MakeHistory(macrotask::Trace());
  for (const TraceReport report :
       {TraceReport::kTotals, TraceReport::kChron, TraceReport::kSync,
        TraceReport::kCpu, TraceReport::kStatus}) {
    const std::string text = TraceReportText(report, history, {});
    EXPECT_NE(text, "") << Name(report);
    EXPECT_EQ(text.find("nan"), std::string::npos) << text;
  }
}

// For the sanitizers: whatever a file claims, it is rejected or reported.
TEST(TraceReports, AnyChangedByteOfAFileDoesNoHarm) {
  const std::string bytes = macrotask::EncodeTrace(ExampleTrace());
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    std::string changed = bytes;
    changed[i] = static_cast<char>(changed[i] ^ (i % 2 == 0 ? 0x80 : 0x03));
    try {
      const TraceHistory history =
          MakeHistory(macrotask::DecodeTrace(changed, "it"));
      for (const TraceReport report :
           {TraceReport::kTotals, TraceReport::kChron, TraceReport::kSync,
            TraceReport::kCpu, TraceReport::kStatus}) {
        EXPECT_NE(TraceReportText(report, history, {}), "") << i;
      }
      EXPECT_NE(PerfettoJson(history), "") << i;
    } catch (const std::runtime_error& error) {
      EXPECT_EQ(std::string(error.what()).find("it "), 0u) << error.what();
    }
  }
}

}  // namespace
}  // namespace bench
