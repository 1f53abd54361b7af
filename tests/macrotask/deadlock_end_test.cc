// How a program ends in a deadlock, and that it need not.

#include <gtest/gtest.h>
#include <sys/time.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <string>

#include "macrotask/barrier.h"
#include "macrotask/deadlock.h"
#include "macrotask/event.h"
#include "macrotask/task.h"
#include "macrotask/trace.h"
#include "tests/macrotask/process.h"
#include "tests/macrotask/support.h"

namespace macrotask {
namespace {

using DeadlockEndTest = InOwnProcess<ByPolicy>;

constexpr const char* kMessage =
    "Deadlock - All user tasks waiting for locks, events, or tasks\n$";

bool Has(const Trace& trace, TraceAction action) {
  for (const TraceBuffer& buffer : trace.buffers) {
    for (const TraceRecord& record : buffer.records) {
      if (record.action == action) return true;
    }
  }
  return false;
}

TEST_P(DeadlockEndTest, WritesTheHistoryTrace) {
  const std::string path = TemporaryDirectory() + "/deadlock.trace";
  std::remove(path.c_str());
  EXPECT_EXIT(
      {
        SetTraceFile(path);
        SetTraceClasses(kAllTraceClasses);
        Event never(GetParam());
        RunTasks(
            3, [&](int) { never.Wait(); }, GetParam());
      },
      testing::ExitedWithCode(kDeadlockExitCode), kMessage);
  const Trace trace = ReadTrace(path);
  EXPECT_EQ(trace.buffers.size(), 3u);
  EXPECT_TRUE(Has(trace, TraceAction::kEventWait));
  EXPECT_FALSE(Has(trace, TraceAction::kEventWaitEnd));
}

TEST_P(DeadlockEndTest, LosesNothingThatTheProgramHasPrinted) {
  const std::string path = TemporaryDirectory() + "/printed";
  EXPECT_EXIT(
      {
        std::FILE* const file = std::fopen(path.c_str(), "w");
        std::fputs("step 7", file);
        Event never(GetParam());
        RunTasks(
            3, [&](int) { never.Wait(); }, GetParam());
      },
      testing::ExitedWithCode(kDeadlockExitCode), kMessage);
  EXPECT_EQ(Contents(path), "step 7");
}

// Their destructors must not wait for the tasks that sleep on them.
TEST_P(DeadlockEndTest, DestroysStaticObjectsOnWhichTasksSleep) {
  EXPECT_EXIT(
      {
        static Event never(GetParam());
        static Barrier barrier(4, GetParam());
        static Task task([] { never.Wait(); }, {.wait = GetParam()});
        RunTasks(
            3, [](int) { barrier.Sync(); }, GetParam());
      },
      testing::ExitedWithCode(kDeadlockExitCode), kMessage);
}

void RaiseAlarmSoon() {
  const itimerval soon = {{0, 0}, {0, 200'000}};
  setitimer(ITIMER_REAL, &soon, nullptr);
}

TEST_P(DeadlockEndTest, DoesNotComeWhenDetectionIsOff) {
  EXPECT_EXIT(
      {
        SetDeadlockDetection(false);
        RaiseAlarmSoon();
        Event never(GetParam());
        RunTasks(
            3, [&](int) { never.Wait(); }, GetParam());
      },
      testing::KilledBySignal(SIGALRM), "^$");
}

TEST_P(DeadlockEndTest, ComesWhenDetectionIsOnAgain) {
  EXPECT_EXIT(
      {
        SetDeadlockDetection(false);
        SetDeadlockDetection(true);
        Event never(GetParam());
        never.Wait();
      },
      testing::ExitedWithCode(kDeadlockExitCode), kMessage);
}

INSTANTIATE_BY_POLICY(DeadlockEndTest);

}  // namespace
}  // namespace macrotask
