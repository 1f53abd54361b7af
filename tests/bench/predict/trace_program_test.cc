#include "bench/predict/trace_program.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <ostream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "bench/predict/marks.h"
#include "bench/predict/simulation.h"
#include "macrotask/barrier.h"
#include "macrotask/event.h"
#include "macrotask/lock.h"
#include "macrotask/task.h"
#include "macrotask/trace.h"
#include "tests/bench/trace_example.h"

namespace bench::predict {

// For the message of a test that fails.
inline void PrintTo(const Step& step, std::ostream* out) {
  *out << "{kind " << static_cast<int>(step.kind) << ", " << Name(step.block)
       << ", object " << step.object << ", " << step.seconds << " s}";
}

namespace {

using enum macrotask::TraceAction;
using enum StepKind;
using Steps = std::vector<Step>;

Program Of(const std::vector<macrotask::TraceBuffer>& buffers) {
  return ProgramOf(HistoryOf(buffers), "it", 0);
}

std::string WhyNot(const macrotask::Trace& trace) {
  try {
    ProgramOf(MakeHistory(trace), "'run.trace'", 0);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

Step Us(double us) { return Compute(Block::kOther, us / 1e6); }

TEST(ProgramOf, ExampleIsWhatItsTasksDo) {
  const Program program = ProgramOf(MakeHistory(ExampleTrace()), "it", 0);
  ASSERT_EQ(program.num_tasks(), 2);
  EXPECT_FALSE(program.tasks[0].started);
  EXPECT_EQ(program.tasks[0].head,
            (Steps{Us(0), Us(5), Sync(kStart, 1), Us(15), Sync(kBarrier, 0),
                   Us(20), Sync(kBarrier, 0), Us(4), Sync(kWait, 0), Us(0),
                   Sync(kClear, 0), Us(5), Sync(kLock, 0), Us(1),
                   Sync(kUnlock, 0), Us(5), Sync(kJoin, 1)}));
  EXPECT_TRUE(program.tasks[1].started);
  EXPECT_EQ(program.tasks[1].head,
            (Steps{Us(19), Sync(kBarrier, 0), Us(15), Sync(kBarrier, 0), Us(9),
                   Sync(kPost, 0), Us(2), Sync(kLock, 0), Us(16),
                   Sync(kUnlock, 0), Us(3), Us(16)}));
  for (const TaskProgram& task : program.tasks) {
    EXPECT_TRUE(task.body.empty() && task.tail.empty());
    EXPECT_EQ(task.num_bodies, 0);
  }
  EXPECT_EQ(program.barriers, std::vector<int>{2});
  EXPECT_EQ(program.num_events, 1);
  EXPECT_EQ(program.num_locks, 1);
  EXPECT_NEAR(Work(program), 135e-6, 1e-15);
}

TEST(ProgramOf, ComputesWithoutTheTimeOfTheRecords) {
  const Program program = ProgramOf(MakeHistory(ExampleTrace()), "it", 1e-6);
  // 9 pieces of task 1, 2 of them empty, and 7 of task 2.
  EXPECT_NEAR(Work(program), 135e-6 - (7 + 7) * 1e-6, 1e-15);
}

TEST(ProgramOf, TasksAreInTheOrderOfTheirNumbers) {
  Script one(1), five(5), three(3);
  one.At(1000, kTaskStart, Data(5))
      .At(1010, kTaskStart, Data(3))
      .Wait(1020, 1050, kTaskWait, Data(5));
  five.At(1005, kTaskBegin).At(1045, kTaskEnd);
  three.At(1012, kTaskBegin).At(1030, kTaskEnd);
  const Program program = Of({five.Buffer(), one.Buffer(), three.Buffer()});
  ASSERT_EQ(program.num_tasks(), 3);
  EXPECT_EQ(program.tasks[0].head,
            (Steps{Sync(kStart, 2), Us(10), Sync(kStart, 1), Us(10),
                   Sync(kJoin, 2)}));
  EXPECT_EQ(program.tasks[1].head, Steps{Us(18)});
  EXPECT_EQ(program.tasks[2].head, Steps{Us(40)});
}

TEST(ProgramOf, TaskThatNobodyStartedComputesFromTheFirstRecordOn) {
  Script one(1), two(2);
  one.At(1000, kEventPost, Data(1));
  two.At(1020, kTaskBegin).At(1030, kTaskEnd);
  const Program program = Of({one.Buffer(), two.Buffer()});
  ASSERT_EQ(program.num_tasks(), 2);
  EXPECT_FALSE(program.tasks[1].started);
  EXPECT_EQ(program.tasks[0].head, Steps{Sync(kPost, 0)});
  EXPECT_EQ(program.tasks[1].head, (Steps{Us(20), Us(10)}));
}

TEST(ProgramOf, TaskThatHasNotBegunIsNone) {
  Script one(1);
  one.At(1000, kTaskStart, Data(2)).At(1010, kTaskWait, Data(2));
  const Program program = Of({one.Buffer()});
  ASSERT_EQ(program.num_tasks(), 1);
  EXPECT_EQ(program.tasks[0].head, Steps{Us(10)});
}

TEST(ProgramOf, PthreadThatWaitsForATaskIsNone) {
  Script one(1), unused(0), idle(9);
  one.At(1000, kTaskBegin).At(1040, kTaskEnd);
  unused.At(1010, kSleep).At(1030, kWake);
  idle.At(1020, kWake);
  const Program program = Of({one.Buffer(), unused.Buffer(), idle.Buffer()});
  ASSERT_EQ(program.num_tasks(), 1);
  EXPECT_EQ(program.tasks[0].head, Steps{Us(40)});
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

// What a real program of three tasks calls, and marks.
class Team {
 public:
  explicit Team(macrotask::WaitPolicy wait)
      : wait_(wait), barrier_(kNumTasks, wait), event_(wait), lock_(wait) {}

  void Run() {
    macrotask::RunTasks(
        kNumTasks, [this](int task) { RunTask(task); }, wait_);
  }
  static Steps Calls(int task) {
    const Step all = Sync(kBarrier, 0);
    Steps calls;
    for (int turn = 0; turn < kNumTurns; ++turn) {
      const Step event = Sync(task == 0 ? kPost : kWait, 0);
      for (const Step& step :
           {all, event, Sync(kLock, 0), Sync(kUnlock, 0), all}) {
        calls.push_back(step);
      }
      if (task == 0) calls.push_back(Sync(kClear, 0));
    }
    return calls;
  }

  static constexpr int kNumTasks = 3;

 private:
  static constexpr int kNumTurns = 5;

  void RunTask(int task) {
    for (int turn = 0; turn < kNumTurns; ++turn) {
      Mark(Block::kOcd);
      barrier_.Sync();
      task == 0 ? event_.Post() : event_.Wait();
      lock_.On();
      ++sum_;
      lock_.Off();
      barrier_.Sync();
      if (task == 0) event_.Clear();
    }
  }

  const macrotask::WaitPolicy wait_;
  macrotask::Barrier barrier_;
  macrotask::Event event_;
  macrotask::Lock lock_;
  int sum_ = 0;
};

// The trace from the moment on at which recording was last switched on.
macrotask::Trace LastRecording(macrotask::Trace trace) {
  std::uint64_t begin = 0;
  for (const macrotask::TraceRecord& record : InOrderOfTime(trace)) {
    if (record.action == kTraceClasses) begin = record.clock;
  }
  for (macrotask::TraceBuffer& buffer : trace.buffers) {
    std::erase_if(buffer.records, [&](const macrotask::TraceRecord& record) {
      return record.clock < begin;
    });
  }
  return trace;
}

Program Record(macrotask::WaitPolicy wait) {
  Team(wait).Run();  // leaves pthreads without tasks behind
  Team team(wait);
  macrotask::SetTraceClasses(macrotask::kAllTraceClasses);
  team.Run();
  macrotask::Trace trace = macrotask::TakeTrace();
  macrotask::SetTraceClasses(0);
  return ProgramOf(MakeHistory(LastRecording(std::move(trace))), "it", 0);
}

// The calls of a task, but for those that start tasks and wait for them.
Steps CallsOf(const TaskProgram& task) {
  Steps calls;
  for (const Step& step : task.head) {
    const bool is_call =
        step.kind != kCompute && step.kind != kStart && step.kind != kJoin;
    if (is_call) calls.push_back(step);
  }
  return calls;
}

void ExpectTeam(const Program& program) {
  ASSERT_EQ(program.num_tasks(), Team::kNumTasks);
  for (int task = 0; task < Team::kNumTasks; ++task) {
    const TaskProgram& own = program.tasks[static_cast<std::size_t>(task)];
    EXPECT_EQ(CallsOf(own), Team::Calls(task));
    EXPECT_EQ(own.started, task != 0);
  }
  EXPECT_EQ(program.barriers, std::vector<int>{Team::kNumTasks});
  EXPECT_EQ(program.num_events, 1);
  EXPECT_EQ(program.num_locks, 1);
  EXPECT_GT(WorkByBlock(program)[static_cast<std::size_t>(Block::kOcd)], 0);
}

void ExpectToRun(const Program& program) {
  for (const int processors : {1, 2, 3}) {
    SimulationOptions options;
    options.processors = processors;
    const SimulationResult result = Simulate(program, options);
    double seconds = 0;
    for (const TaskTimes& task : result.tasks) seconds += task.compute;
    // A sum of a hundred terms in another order.
    EXPECT_NEAR(seconds, Work(program), 1e-13 * Work(program));
    EXPECT_GE(result.seconds * processors, seconds * (1 - 1e-13));
  }
}

TEST(ProgramOf, RealProgramCanBeSimulatedHoweverItsTasksWait) {
  using macrotask::WaitPolicy;
  for (const WaitPolicy wait : {WaitPolicy(), WaitPolicy::Hold(),
                                WaitPolicy::Block(), WaitPolicy::Logical()}) {
    SCOPED_TRACE(Name(wait.kind));
    const Program program = Record(wait);
    ASSERT_NO_FATAL_FAILURE(ExpectTeam(program));
    ExpectToRun(program);
  }
}

}  // namespace
}  // namespace bench::predict
