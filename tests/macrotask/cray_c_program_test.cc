// What the C interface prints, tunes and leaves behind.

#include <gtest/gtest.h>
#include <pthread.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <string>
#include <vector>

#include "macrotask/clock.h"
#include "macrotask/cray.h"
#include "macrotask/cray/objects.h"
#include "macrotask/cray/tuning.h"
#include "macrotask/placement.h"
#include "macrotask/trace.h"
#include "macrotask/trace_text.h"
#include "tests/macrotask/cray_support.h"
#include "tests/macrotask/process.h"

namespace macrotask {
namespace {

using CrayProgramTest = InOwnProcess<testing::Test>;

// Ends the program with code 0 if `condition`.
[[noreturn]] void ExitWell(bool condition) { std::exit(condition ? 0 : 1); }

TEST_F(CrayProgramTest, TskvalueIsZeroBeforeAnyTskstart) {
  const auto program = [] {
    long value = 7;
    int value_32 = 7;
    TSKVALUE(&value);
    TSKVALUE(&value_32);
    ExitWell(value == 0 && value_32 == 0);
  };
  EXPECT_EXIT(program(), testing::ExitedWithCode(0), "^$");
}

TEST_F(CrayProgramTest, EndsWhileTasksWaitOrSpinForEver) {
  const auto program = [] {
    static long never = 0, set = 0;
    EVASGN(&never);
    LOCKASGN(&set);
    LOCKON(&set);
    static const auto* const waiting =
        new CrayTasks<long>(2, [](int) { EVWAIT(&never); });
    static const auto* const spinning = new CrayTasks<long>(2, [](int) {
      while (LOCKTEST(&set)) {
      }
    });
    YieldUntil([] { return NumWaitingTasks() == 2; });
    ExitWell(waiting != nullptr && spinning != nullptr);
  };
  EXPECT_EXIT(program(), testing::ExitedWithCode(0), "^$");
}

TEST_F(CrayProgramTest, DeadlockIsSeen) {
  const auto program = [] {
    int lock = 0;
    LOCKASGN(&lock);
    LOCKON(&lock);
    LOCKON(&lock);
  };
  EXPECT_EXIT(program(), testing::ExitedWithCode(3),
              "Cycle: task 1 waits for lock 1, held by task 1\n"
              "Deadlock - All user tasks waiting for locks, events, or tasks");
}

// --- How tasks wait ---------------------------------------------------------

TEST_F(CrayProgramTest, TheEnvironmentChoosesHowTasksWait) {
  struct Choice {
    const char* name;
    WaitKind kind;
  };
  for (const auto& [name, kind] :
       {Choice{"block", WaitKind::kBlock}, Choice{"spin", WaitKind::kSpin},
        Choice{"hold", WaitKind::kHold}, Choice{"", WaitKind::kHold}}) {
    setenv("MACROTASK_WAIT", name, 1);
    const auto program = [&] {
      int barrier = 0;
      BARASGN(&barrier, 3);
      RunCrayTasks<int>(3, [&](int) { BARSYNC(&barrier); });
      ExitWell(cray::TunedPolicy().kind == kind);
    };
    EXPECT_EXIT(program(), testing::ExitedWithCode(0), "^$") << name;
  }
  setenv("MACROTASK_WAIT", "nonsense", 1);
  int lock = 0;
  EXPECT_EXIT(LOCKASGN(&lock), testing::ExitedWithCode(2),
              "^macrotask: LOCKASGN \\(task 1, at .*\\): MACROTASK_WAIT is "
              "'nonsense': expected block, spin or hold\n$");
  unsetenv("MACROTASK_WAIT");
}

TEST_F(CrayProgramTest, EndsThoughWhatItsEndCallsIsABadCallAgain) {
  const auto program = [] {
    static int lock = 0;
    static int event = 0;
    LOCKASGN(&lock);
    LOCKON(&lock);
    std::atexit([] { LOCKREL(&lock); });
    EVPOST(&event);
  };
  EXPECT_EXIT(program(), testing::ExitedWithCode(2),
              "^macrotask: EVPOST [^\n]*\n$");
}

extern "C" void AddTo(long* sum, long addend) { *sum += addend; }

TEST(CrayCppTest, StartsARoutineOfAnyArgumentsWithoutACast) {
  long sum = 1;
  long tca[2] = {2, 0};
  int short_tca[2] = {2, 0};
  TSKSTART(tca, AddTo, &sum, 20L);
  TSKWAIT(tca);
  TSKSTART(short_tca, AddTo, &sum, 300L);
  TSKWAIT(short_tca);
  EXPECT_EQ(sum, 321);
}

class TsktuneTest : public testing::Test {
 protected:
  TsktuneTest() {
    SetTraceClasses(static_cast<std::uint32_t>(TraceClass::kInfo));
    begin_ = ReadStamp().clock;
  }
  ~TsktuneTest() override {
    SetTraceClasses(0);
    TSKTUNE("MAXCPU", 1 << 20, "HOLDTIME", 50, "STACKSZ", 0);
  }

  // What was set: "MAXCPU = 1", ...
  std::vector<std::string> Tuned() const {
    std::vector<std::string> tuned;
    for (const TraceRecord& record : InOrderOfTime(TakeTrace())) {
      if (record.clock < begin_) continue;
      tuned.push_back(DetailText(record));
    }
    return tuned;
  }

 private:
  std::uint64_t begin_;
};

// Also of objects that were released, or are assigned again.
TEST_F(TsktuneTest, HoldTimeIsThatOfTheLastAssignment) {
  const auto hold_time_of = [](int lock) {
    return cray::LockOf(lock).policy().hold_time;
  };
  int first = 0, second = 0, third = 0;
  TSKTUNE("HOLDTIME", 3L);
  LOCKASGN(&first);
  LOCKASGN(&second);
  TSKTUNE("HOLDTIME", 7L);
  LOCKREL(&first);
  LOCKASGN(&third);
  EXPECT_EQ(hold_time_of(third), std::chrono::microseconds(7));
  EXPECT_EQ(hold_time_of(second), std::chrono::microseconds(3));
  LOCKASGN(&second);
  EXPECT_EQ(hold_time_of(second), std::chrono::microseconds(7));
}

TEST_F(TsktuneTest, TakesOnePair) {
  TSKTUNE("HOLDTIME", 123);
  EXPECT_EQ(Tuned(), std::vector<std::string>{"HOLDTIME = 123"});
  EXPECT_EQ(cray::TunedPolicy(),
            WaitPolicy::Hold(std::chrono::microseconds(123)));
  TSKTUNE("HOLDTIME", 0);
  EXPECT_EQ(cray::TunedPolicy().kind, WaitKind::kBlock);
}

TEST_F(TsktuneTest, TakesTwoPairs) {
  TSKTUNE("MAXCPU", 1, "HOLDTIME", 7L);
  EXPECT_EQ(Tuned(), (std::vector<std::string>{"MAXCPU = 1", "HOLDTIME = 7"}));
  EXPECT_EQ(NumProcessors(), 1);
  EXPECT_EQ(cray::TunedPolicy().hold_time, std::chrono::microseconds(7));
}

TEST_F(TsktuneTest, TakesFivePairsOfIntsAndLongs) {
  TSKTUNE("dbreleas", 1, "DBACTIVE", 2L, "SAMPLE  ", 3, "STACKSZ", 40'000L,
          "HOLDTIME", 2'147'483'647);
  EXPECT_EQ(Tuned(), (std::vector<std::string>{"DBRELEAS = 1", "DBACTIVE = 2",
                                               "SAMPLE = 3", "STACKSZ = 40000",
                                               "HOLDTIME = 2147483647"}));
}

std::size_t StackOfTask() {
  std::size_t size = 0;
  RunCrayTasks<int>(1, [&](int) {
    pthread_attr_t attributes;
    pthread_getattr_np(pthread_self(), &attributes);
    pthread_attr_getstacksize(&attributes, &size);
    pthread_attr_destroy(&attributes);
  });
  return size;
}

TEST_F(TsktuneTest, StackszIsInWordsAndForTasksThatStartAfterwards) {
  const std::size_t usual = StackOfTask();
  TSKTUNE("STACKSZ", 307'200);
  EXPECT_EQ(StackOfTask(), 307'200u * 8);
  TSKTUNE("STACKSZ", 0);
  EXPECT_EQ(StackOfTask(), usual);
}

// --- What is printed --------------------------------------------------------

std::string PrintedBy(const std::function<void()>& body) {
  testing::internal::CaptureStdout();
  body();
  return testing::internal::GetCapturedStdout();
}

TEST(CrayPrintingTest, TsklistPrintsTheTasks) {
  long event = 0, tca[3] = {3, 0, 0x4847464544434241};
  EVASGN(&event);
  std::function<void(int)> body = [&](int) { EVWAIT(&event); };
  TSKSTART(tca, AsRoutine(&CrayTaskBody), &body, 0L);
  YieldUntil([] { return NumWaitingTasks() == 1; });
  const std::string text = PrintedBy([] { TSKLIST(); });
  EVPOST(&event);
  TSKWAIT(tca);
  EXPECT_NE(text.find("     1  0                              running\n"),
            std::string::npos);
  EXPECT_NE(text.find("  4847464544434241 'ABCDEFGH'    waiting for event "),
            std::string::npos);
  EXPECT_NE(text.find(" 1 waiting\n"), std::string::npos);
}

TEST(CrayPrintingTest, MttimesPrintsTheTable) {
  const std::string text = PrintedBy([] { MTTIMES(); });
  EXPECT_EQ(text.find("  processors busy     seconds   share\n"), 0u);
  EXPECT_NE(text.find("  average concurrency "), std::string::npos);
}

TEST(CrayPrintingTest, BufprintPrintsTheTrace) {
  BUFTUNE("users", "on ");
  EXPECT_EQ(TraceClasses(), static_cast<std::uint32_t>(TraceClass::kUsers));
  BUFUSER(99, 0xabc);
  const std::string text = PrintedBy([] { BUFPRINT(); });
  BUFTUNE("USERS", "OFF");
  EXPECT_EQ(TraceClasses(), 0u);
  EXPECT_NE(text.find("  USERS   user 99         0xabc\n"), std::string::npos);
}

// --- The trace file ---------------------------------------------------------

int NumUserRecords(const Trace& trace) {
  int number = 0;
  for (const TraceBuffer& buffer : trace.buffers) {
    for (const TraceRecord& record : buffer.records) {
      number += ClassOf(record.action) == TraceClass::kUsers;
    }
  }
  return number;
}

TEST_F(CrayProgramTest, BuftuneDnWritesTheTraceAtTheEnd) {
  const std::string path = TemporaryDirectory() + "/cray.trace";
  std::remove(path.c_str());
  const auto program = [&] {
    BUFTUNE("DN", (path + "   ").c_str());
    RunCrayTasks<int>(3, [](int task) { BUFUSER(65, task); });
    ExitWell(true);
  };
  EXPECT_EXIT(program(), testing::ExitedWithCode(0), "^$");
  const Trace trace = ReadTrace(path);
  EXPECT_EQ(NumUserRecords(trace), 3);
  EXPECT_EQ(trace.classes, kAllTraceClasses);
}

TEST_F(CrayProgramTest, BufdumpWritesAtOnceAndBadCallsLoseNothing) {
  const std::string path = TemporaryDirectory() + "/dumped.trace";
  const auto program = [&] {
    BUFTUNE("USERS", "ON");
    BUFTUNE("DN", path.c_str());
    BUFUSER(65, 1);
    BUFDUMP();
    if (NumUserRecords(ReadTrace(path)) != 1) std::exit(1);
    BUFUSER(65, 2);
    BUFUSER(64, 3);
  };
  EXPECT_EXIT(program(), testing::ExitedWithCode(2), "BUFUSER");
  const Trace trace = ReadTrace(path);
  EXPECT_EQ(NumUserRecords(trace), 2);
  EXPECT_EQ(trace.classes, static_cast<std::uint32_t>(TraceClass::kUsers));
}

TEST_F(CrayProgramTest, BufdumpHasANameWithoutDn) {
  const auto program = [] {
    if (chdir(TemporaryDirectory().c_str()) != 0) std::exit(1);
    BUFTUNE("USERS", "ON");
    BUFUSER(65, 1);
    BUFDUMP();
    ExitWell(NumUserRecords(ReadTrace("macrotask.trace")) == 1);
  };
  EXPECT_EXIT(program(), testing::ExitedWithCode(0), "^$");
}

// --- Times ------------------------------------------------------------------

TEST(TsecndTest, CountsTheCallingTaskOnly) {
  constexpr double kWork = 0.05;
  TSKTUNE("HOLDTIME", 0);
  const double mine = TSECND();
  double at_begin[2], at_end[2];
  for (int round = 0; round < 2; ++round) {
    RunCrayTasks<int>(1, [&](int) {
      at_begin[round] = TSECND();
      while (TSECND() < kWork) {
      }
      at_end[round] = TSECND();
    });
  }
  TSKTUNE("HOLDTIME", 50);
  for (int round = 0; round < 2; ++round) {
    EXPECT_GE(at_begin[round], 0);
    EXPECT_LT(at_begin[round], kWork / 2);
    EXPECT_GE(at_end[round], kWork);
  }
  // The initial task has slept meanwhile.
  EXPECT_GE(TSECND(), mine);
  EXPECT_LT(TSECND() - mine, kWork);
}

}  // namespace
}  // namespace macrotask
