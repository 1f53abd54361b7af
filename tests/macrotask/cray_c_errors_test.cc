// Bad calls of the C interface: each ends the program with exit code 2 and one
// sentence that names the routine.

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

#include "macrotask/cray.h"
#include "tests/macrotask/cray_support.h"
#include "tests/macrotask/process.h"

namespace macrotask {
namespace {

// What a bad call of the initial task prints.
std::string Sentence(const std::string& routine, const std::string& what,
                     const std::string& task = "1") {
  std::string begin = Exactly("macrotask: " + routine + " (task " + task);
  begin.pop_back();  // $
  return begin + ", at [^\n]*\\+0x[0-9a-f]+( in [^\n]*)?\\): " +
         Exactly(what + "\n").substr(1);
}

#define EXPECT_BAD_CALL(statement, routine, what) \
  EXPECT_EXIT(statement, testing::ExitedWithCode(2), Sentence(routine, what))

// --- A handle that is none --------------------------------------------------

// A routine that takes a handle.
struct HandleRoutine {
  const char* name;
  const char* noun;
  const char* expected;
  void (*call)(long* handle);
  void (*call_32)(int* handle);
};

constexpr const char* kLock = ": expected a lock, assigned by LOCKASGN";
constexpr const char* kEvent = ": expected an event, assigned by EVASGN";
constexpr const char* kBarrier = ": expected a barrier, assigned by BARASGN";

#define ROUTINE(name, noun, expected)                                         \
  {                                                                           \
#name, noun, expected,                                                    \
        [](long* handle) { name(handle); }, [](int* handle) { name(handle); } \
  }

const HandleRoutine kRoutines[] = {
    ROUTINE(LOCKON, "lock", kLock),      ROUTINE(LOCKOFF, "lock", kLock),
    ROUTINE(LOCKTEST, "lock", kLock),    ROUTINE(LOCKREL, "lock", kLock),
    ROUTINE(EVPOST, "event", kEvent),    ROUTINE(EVWAIT, "event", kEvent),
    ROUTINE(EVCLEAR, "event", kEvent),   ROUTINE(EVTEST, "event", kEvent),
    ROUTINE(EVREL, "event", kEvent),     ROUTINE(BARSYNC, "barrier", kBarrier),
    ROUTINE(BARREL, "barrier", kBarrier)};

void Call(const HandleRoutine& routine, long* handle) { routine.call(handle); }
void Call(const HandleRoutine& routine, int* handle) {
  routine.call_32(handle);
}

void PrintTo(const HandleRoutine& routine, std::ostream* out) {
  *out << routine.name;
}

class CrayHandleTest
    : public InOwnProcess<testing::TestWithParam<HandleRoutine>> {
 protected:
  // For both widths.
  template <typename Program>
  void ExpectBad(const std::string& what, const Program& program) {
    const HandleRoutine& routine = GetParam();
    EXPECT_BAD_CALL(program(long{}), routine.name, what + routine.expected);
    EXPECT_BAD_CALL(program(int{}), routine.name, what + routine.expected);
  }
};

TEST_P(CrayHandleTest, IsNeverZero) {
  ExpectBad("the variable holds 0", [](auto handle) {
    handle = 0;
    Call(GetParam(), &handle);
  });
}

TEST_P(CrayHandleTest, IsNoGarbage) {
  ExpectBad("the variable holds -123456", [](auto handle) {
    handle = -123'456;
    Call(GetParam(), &handle);
  });
}

TEST_P(CrayHandleTest, IsOfTheRightKind) {
  const std::string noun = GetParam().noun;
  const std::string other = noun == "lock"    ? "an event"
                            : noun == "event" ? "a barrier"
                                              : "a lock";
  ExpectBad("the variable holds " + other, [&](auto handle) {
    handle = 0;
    if (other == "an event") EVASGN(&handle);
    if (other == "a barrier") BARASGN(&handle, 2);
    if (other == "a lock") LOCKASGN(&handle);
    Call(GetParam(), &handle);
  });
}

template <typename Word>
void AssignAndRelease(const std::string& noun, Word* handle) {
  if (noun == "lock") {
    LOCKASGN(handle);
    LOCKREL(handle);
  } else if (noun == "event") {
    EVASGN(handle);
    EVREL(handle);
  } else {
    BARASGN(handle, 2);
    BARREL(handle);
  }
}

TEST_P(CrayHandleTest, IsNotUsedAfterItsRelease) {
  const std::string noun = GetParam().noun;
  ExpectBad("the " + noun + " of this variable was released", [&](auto handle) {
    handle = 0;
    AssignAndRelease(noun, &handle);
    Call(GetParam(), &handle);
  });
}

// The object is another variable's by then.
TEST_P(CrayHandleTest, IsNotUsedAfterItsReleaseByACopy) {
  const std::string noun = GetParam().noun;
  ExpectBad("the " + noun + " of this variable was released", [&](auto handle) {
    handle = 0;
    AssignAndRelease(noun, &handle);
    auto other = decltype(handle){0};
    if (noun == "lock") LOCKASGN(&other);
    if (noun == "event") EVASGN(&other);
    if (noun == "barrier") BARASGN(&other, 2);
    Call(GetParam(), &handle);
  });
}

std::string RoutineName(const testing::TestParamInfo<HandleRoutine>& routine) {
  return routine.param.name;
}

INSTANTIATE_TEST_SUITE_P(Routines, CrayHandleTest, testing::ValuesIn(kRoutines),
                         RoutineName);

// --- Everything else --------------------------------------------------------

using CrayErrorTest = InOwnProcess<testing::Test>;

long handle = 0;

// Starts tasks that wait in `wait()`, then calls `call()`.
void CallBesideWaiting(int num_tasks, const std::function<void()>& wait,
                       const std::function<void()>& call) {
  // Never destroyed, which would wait for them.
  static const auto* const tasks =
      new CrayTasks<long>(num_tasks, [&](int) { wait(); });
  static_cast<void>(tasks);
  YieldUntil([&] { return NumWaitingTasks() == num_tasks; });
  call();
}

TEST_F(CrayErrorTest, ALockForWhichTasksWaitIsNotAssignedAgain) {
  const auto assign = [] {
    LOCKASGN(&handle);
    LOCKON(&handle);
    CallBesideWaiting(
        1, [] { LOCKON(&handle); }, [] { LOCKASGN(&handle); });
  };
  EXPECT_BAD_CALL(assign(), "LOCKASGN", "1 task waits for the lock");
}

TEST_F(CrayErrorTest, ASetLockIsNotReleased) {
  const auto release = [] {
    LOCKASGN(&handle);
    LOCKON(&handle);
    LOCKREL(&handle);
  };
  EXPECT_BAD_CALL(release(), "LOCKREL", "the lock is set, by task 1");
}

TEST_F(CrayErrorTest, AnEventForWhichTasksWaitIsNotReleased) {
  const auto release = [] {
    EVASGN(&handle);
    CallBesideWaiting(
        3, [] { EVWAIT(&handle); }, [] { EVREL(&handle); });
  };
  EXPECT_BAD_CALL(release(), "EVREL", "3 tasks wait for the event");
}

TEST_F(CrayErrorTest, ABarrierAtWhichTasksWaitIsNeitherReleasedNorAssigned) {
  const auto beside = [](void (*call)()) {
    BARASGN(&handle, 3);
    CallBesideWaiting(
        2, [] { BARSYNC(&handle); }, call);
  };
  EXPECT_BAD_CALL(beside([] { BARREL(&handle); }), "BARREL",
                  "2 tasks wait at the barrier");
  EXPECT_BAD_CALL(beside([] { BARASGN(&handle, 3); }), "BARASGN",
                  "2 tasks wait at the barrier");
}

TEST_F(CrayErrorTest, ABarrierNeedsATaskAndNoMoreThanAMillion) {
  for (const long number : {0L, -3L, 1'000'001L, 1L << 32}) {
    EXPECT_BAD_CALL(BARASGN(&handle, number), "BARASGN",
                    "a barrier of " + std::to_string(number) +
                        " tasks: expected 1 to 1000000");
  }
}

TEST_F(CrayErrorTest, ThereAreNoMoreHandlesThanFit) {
  const auto assign = [](auto routine) {
    std::vector<int> handles(70'000);
    for (int& each : handles) routine(&each);
  };
  const std::string what = "65536 are assigned already, no more are possible";
  EXPECT_BAD_CALL(assign([](int* lock) { LOCKASGN(lock); }), "LOCKASGN", what);
  EXPECT_BAD_CALL(assign([](int* event) { EVASGN(event); }), "EVASGN", what);
  EXPECT_BAD_CALL(assign([](int* barrier) { BARASGN(barrier, 2); }), "BARASGN",
                  what);
}

extern "C" void DoNothing() {}

TEST_F(CrayErrorTest, ATaskControlArrayHasTwoOrThreeWords) {
  for (const int length : {0, 1, 4, -2}) {
    int tca[4] = {length, 0, 0, 0};
    EXPECT_BAD_CALL(TSKSTART(tca, &DoNothing), "TSKSTART",
                    "the task control array says it has " +
                        std::to_string(length) +
                        " words: expected 2, or 3 with a user value");
  }
}

TEST_F(CrayErrorTest, ATaskNeedsARoutine) {
  long tca[2] = {2, 0};
  EXPECT_BAD_CALL(TSKSTART(tca, nullptr), "TSKSTART",
                  "the routine to start is null");
}

TEST_F(CrayErrorTest, TsktuneKnowsItsKeywordsAndTheirValues) {
  EXPECT_BAD_CALL(TSKTUNE("MAXCPU", 1, "MAXCPUS", 2), "TSKTUNE",
                  "unknown keyword 'MAXCPUS': expected one of MAXCPU, "
                  "DBRELEAS, DBACTIVE, HOLDTIME, SAMPLE, STACKSZ");
  EXPECT_BAD_CALL(TSKTUNE("", 1), "TSKTUNE",
                  "unknown keyword '': expected one of MAXCPU, DBRELEAS, "
                  "DBACTIVE, HOLDTIME, SAMPLE, STACKSZ");
  EXPECT_BAD_CALL(TSKTUNE("MAXCPU", 0), "TSKTUNE",
                  "MAXCPU of 0: expected 1 to 2147483647");
  EXPECT_BAD_CALL(TSKTUNE("HOLDTIME", -1), "TSKTUNE",
                  "HOLDTIME of -1: expected 0 to 2147483647");
  EXPECT_BAD_CALL(TSKTUNE("SAMPLE", 1L << 32), "TSKTUNE",
                  "SAMPLE of 4294967296: expected 0 to 2147483647");
  EXPECT_BAD_CALL(TSKTUNE("STACKSZ", 2047), "TSKTUNE",
                  "STACKSZ of 2047: expected 0 or 2048 to 2147483647");
}

TEST_F(CrayErrorTest, BuftuneKnowsItsKeywordsAndTheirValues) {
  EXPECT_BAD_CALL(BUFTUNE("CPU", "ON"), "BUFTUNE",
                  "unknown keyword 'CPU': expected one of DN, TASKS, LOCKS, "
                  "EVENTS, CPUS, USERS, INFO, SIZE");
  EXPECT_BAD_CALL(BUFTUNE("TASKS", "MAYBE"), "BUFTUNE",
                  "TASKS of 'MAYBE': expected ON or OFF");
  for (const char* const size : {"", "x", "12x", "-1"}) {
    EXPECT_BAD_CALL(
        BUFTUNE("SIZE", size), "BUFTUNE",
        "SIZE of '" + std::string(size) + "': expected a number of records");
  }
  EXPECT_BAD_CALL(BUFTUNE("SIZE", "1"), "BUFTUNE",
                  "a history trace of 1 records: expected 2 to 268435456");
}

TEST_F(CrayErrorTest, BufuserTakesActions65To128) {
  EXPECT_BAD_CALL(BUFUSER(64, 1), "BUFUSER",
                  "user action 64: expected 65 to 128");
  EXPECT_BAD_CALL(BUFUSER(129, 1), "BUFUSER",
                  "user action 129: expected 65 to 128");
}

TEST_F(CrayErrorTest, BufdumpSaysWhyItCannotWrite) {
  const std::string path = TemporaryDirectory() + "/none/trace";
  const auto dump = [&] {
    BUFTUNE("DN", path.c_str());
    BUFTUNE("DN", path.c_str());
    BUFDUMP();
  };
  // The end of the program tries once more.
  const std::string why =
      "cannot write '" + path + "': No such file or directory\n";
  EXPECT_EXIT(dump(), testing::ExitedWithCode(2),
              "macrotask: BUFDUMP \\(task 1, at [^\n]*\\): " +
                  Exactly(why).substr(1, Exactly(why).size() - 2));
}

void FailInATask() { LOCKON(&handle); }

TEST_F(CrayErrorTest, TheSentenceNamesTheTask) {
  EXPECT_EXIT(
      RunCrayTasks<long>(1, [](int) { FailInATask(); }),
      testing::ExitedWithCode(2),
      Sentence("LOCKON", std::string("the variable holds 0") + kLock, "2"));
}

}  // namespace
}  // namespace macrotask
