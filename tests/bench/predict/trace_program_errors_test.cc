#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "bench/predict/trace_program.h"
#include "macrotask/trace.h"
#include "tests/bench/trace_example.h"

namespace bench::predict {
namespace {

using enum macrotask::TraceAction;

std::string WhyNot(const macrotask::Trace& trace) {
  try {
    ProgramOf(MakeHistory(trace), "'run.trace'", 0);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

TEST(ProgramOf, NeedsTheClassesOfAllCalls) {
  macrotask::Trace trace = ExampleTrace();
  trace.classes = 7;
  EXPECT_EQ(WhyNot(trace), "");
  trace.classes = 6;
  EXPECT_EQ(WhyNot(trace),
            "'run.trace' was recorded without TASKS: expected TASKS, LOCKS and "
            "EVENTS from beginning to end");
  trace.classes = 5;
  EXPECT_EQ(WhyNot(trace),
            "'run.trace' was recorded without LOCKS: expected TASKS, LOCKS and "
            "EVENTS from beginning to end");
  trace.classes = 3;
  EXPECT_EQ(WhyNot(trace),
            "'run.trace' was recorded without EVENTS: expected TASKS, LOCKS "
            "and EVENTS from beginning to end");
}

TEST(ProgramOf, NeedsTheClassesAllTheTime) {
  Script one(1);
  one.At(1000, kTraceClasses, 32)
      .At(1001, kTune, Data(50, 4))
      .At(1002, kTraceClasses, 63)
      .At(1003, kEventPost, Data(1));
  EXPECT_EQ(WhyNot(TraceOf({one.Buffer()})), "");
  one.At(1010, kTraceClasses, 61)
      .At(1020, kEventPost, Data(1))
      .At(1030, kTraceClasses, 63);
  EXPECT_EQ(WhyNot(TraceOf({one.Buffer()})),
            "'run.trace' was recorded without LOCKS: expected TASKS, LOCKS and "
            "EVENTS from beginning to end");
}

TEST(ProgramOf, RejectsALeanTrace) {
  Script one(1);
  one.At(1000, kTraceClasses,
         macrotask::kAllTraceClasses | macrotask::kLeanTrace)
      .At(1010, kEventPost, Data(1));
  EXPECT_EQ(WhyNot(TraceOf({one.Buffer()})),
            "'run.trace' was recorded as a lean trace: expected a full one");
}

TEST(ProgramOf, RejectsATraceThatHasLostRecords) {
  Script one(1);
  one.At(1000, kEventPost, Data(1));
  EXPECT_EQ(WhyNot(TraceOf({one.Buffer(1)})),
            "'run.trace' has lost 1 record: expected a trace that has them "
            "all");
  EXPECT_EQ(WhyNot(TraceOf({one.Buffer(1), Script(2).Buffer(6)})),
            "'run.trace' has lost 7 records: expected a trace that has them "
            "all");
}

TEST(ProgramOf, RejectsATraceWithoutTasks) {
  const char* const kSentence =
      "'run.trace' has no records: expected those of a task";
  EXPECT_EQ(WhyNot(TraceOf({})), kSentence);
  Script idle(0);
  idle.At(1010, kSleep);
  EXPECT_EQ(WhyNot(TraceOf({idle.Buffer()})), kSentence);
}

TEST(ProgramOf, RejectsATaskThatIsStartedTwice) {
  Script one(1), two(2);
  one.At(1000, kTaskStart, Data(3));
  two.At(1010, kTaskStart, Data(3));
  EXPECT_EQ(WhyNot(TraceOf({one.Buffer(), two.Buffer()})),
            "'run.trace' shows that task 3 is started twice: expected once");
}

TEST(ProgramOf, RejectsABarrierOfDifferentNumbersOfTasks) {
  Script one(1), two(2);
  one.Wait(1000, 1010, kBarrierSync, Data(6, 4));
  two.Wait(1000, 1010, kBarrierSync, Data(6, 2));
  EXPECT_EQ(WhyNot(TraceOf({one.Buffer(), two.Buffer()})),
            "'run.trace' shows that barrier 6 is of 2 tasks and of 4: expected "
            "one number of tasks");
}

}  // namespace
}  // namespace bench::predict
