#include "bench/predict/trace_program.h"

#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <numeric>
#include <utility>
#include <vector>

#include "bench/predict/marks.h"
#include "bench/predict/simulation.h"
#include "macrotask/barrier.h"
#include "macrotask/event.h"
#include "macrotask/lock.h"
#include "macrotask/placement.h"
#include "macrotask/task.h"
#include "macrotask/trace.h"
#include "tests/bench/predict/print_step.h"
#include "tests/bench/trace_example.h"

namespace bench::predict {

namespace {

using enum macrotask::TraceAction;
using enum StepKind;
using Steps = std::vector<Step>;

Program Of(const std::vector<macrotask::TraceBuffer>& buffers) {
  return ProgramOf(HistoryOf(buffers), "it", 0);
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

Program Record(const std::function<void()>& run) {
  macrotask::SetTraceClasses(macrotask::kAllTraceClasses);
  run();
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
    Team(wait).Run();  // leaves pthreads without tasks behind
    Team team(wait);
    const Program program = Record([&] { team.Run(); });
    ASSERT_NO_FATAL_FAILURE(ExpectTeam(program));
    ExpectToRun(program);
  }
}

// Computes `wanted` seconds or, interrupted, some more. Returns how many.
double ComputeFor(double wanted) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point start = Clock::now();
  std::chrono::duration<double> seconds{};
  while (seconds.count() < wanted) seconds = Clock::now() - start;
  return seconds.count();
}

// Six tasks that compute 1, 2, ..., 6 ms, three on each of two processors, one
// after the other. If the first one of each had the time of its neighbours too,
// it would be 37 ms of 21. The bounds leave room for whoever else computes.
TEST(ProgramOf, LogicalTaskThatBearsThePthreadDoesNotComputeForItsNeighbours) {
  const int num_processors = macrotask::NumProcessors();
  macrotask::SetMaxProcessors(2);
  std::array<double, 6> seconds{};
  const Program program = Record([&] {
    macrotask::RunTasks(
        6,
        [&](int task) {
          seconds[static_cast<std::size_t>(task)] =
              ComputeFor(1e-3 * (task + 1));
        },
        macrotask::WaitPolicy::Logical());
  });
  macrotask::SetMaxProcessors(num_processors);
  ASSERT_EQ(program.num_tasks(), 6);
  const double sum = std::accumulate(seconds.begin(), seconds.end(), 0.0);
  EXPECT_GE(Work(program), 0.9 * sum);
  EXPECT_LT(Work(program), 1.5 * sum);
  ExpectToRun(program);
}

}  // namespace
}  // namespace bench::predict
