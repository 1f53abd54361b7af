// The history trace at the end of a program.

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <set>
#include <string>

#include "macrotask/event.h"
#include "macrotask/task.h"
#include "macrotask/trace.h"
#include "tests/macrotask/process.h"

namespace macrotask {
namespace {

class TraceEndTest : public InOwnProcess<testing::Test> {
 protected:
  // A file that does not exist yet.
  TraceEndTest() : path_(TemporaryDirectory() + "/end.trace") {
    std::remove(path_.c_str());
  }

  const std::string path_;
};

void ExitByItself() { std::exit(0); }

void Trace65(const std::string& path) {
  SetTraceFile(path);
  SetTraceClasses(kAllTraceClasses);
  RunTasks(
      3, [](int task) { RecordUser(65, static_cast<std::uint64_t>(task)); },
      WaitPolicy::Hold());
}

// The data of all entries 65.
std::multiset<std::uint64_t> DataOf65(const Trace& trace) {
  std::multiset<std::uint64_t> data;
  for (const TraceBuffer& buffer : trace.buffers) {
    for (const TraceRecord& record : buffer.records) {
      if (record.action == TraceAction{65}) data.insert(record.data);
    }
  }
  return data;
}

TEST_F(TraceEndTest, IsWrittenAtTheNormalEnd) {
  EXPECT_EXIT(
      {
        Trace65(path_);
        ExitByItself();
      },
      testing::ExitedWithCode(0), "^$");
  EXPECT_EQ(DataOf65(ReadTrace(path_)),
            (std::multiset<std::uint64_t>{0, 1, 2}));
}

void ExitBesideATask(const std::string& path) {
  Trace65(path);
  static Event& never = *new Event;
  static Event& running = *new Event;
  new Task([] {
    running.Post();
    never.Wait();
  });
  running.Wait();
  ExitByItself();
}

TEST_F(TraceEndTest, IsWrittenWhileATaskLives) {
  EXPECT_EXIT(ExitBesideATask(path_), testing::ExitedWithCode(0), "^$");
  EXPECT_EQ(DataOf65(ReadTrace(path_)).size(), 3u);
}

TEST_F(TraceEndTest, IsNotWrittenWithoutAName) {
  EXPECT_EXIT(
      {
        Trace65(path_);
        SetTraceFile("");
        ExitByItself();
      },
      testing::ExitedWithCode(0), "^$");
  EXPECT_NE(access(path_.c_str(), F_OK), 0);
}

TEST_F(TraceEndTest, GoesToTheFileNamedLast) {
  const std::string other = TemporaryDirectory() + "/other.trace";
  EXPECT_EXIT(
      {
        Trace65(other);
        SetTraceFile(path_);
        ExitByItself();
      },
      testing::ExitedWithCode(0), "^$");
  EXPECT_EQ(DataOf65(ReadTrace(path_)).size(), 3u);
  EXPECT_NE(access(other.c_str(), F_OK), 0);
}

TEST_F(TraceEndTest, SaysThatItCannotBeWritten) {
  const std::string path = TemporaryDirectory() + "/none/end.trace";
  EXPECT_EXIT(
      {
        Trace65(path);
        ExitByItself();
      },
      testing::ExitedWithCode(0),
      "^macrotask: cannot write '.*/none/end.trace': "
      "No such file or directory\n$");
}

TEST_F(TraceEndTest, IsSwitchedOnByTheEnvironment) {
  setenv("MACROTASK_TRACE", path_.c_str(), 1);
  EXPECT_EXIT(
      {
        if (TraceFile() != path_) _exit(1);
        if (TraceClasses() != kAllTraceClasses) _exit(2);
        RunTasks(
            2, [](int) { RecordUser(65, 7); }, WaitPolicy::Hold());
        ExitByItself();
      },
      testing::ExitedWithCode(0), "^$");
  unsetenv("MACROTASK_TRACE");
  EXPECT_EQ(DataOf65(ReadTrace(path_)), (std::multiset<std::uint64_t>{7, 7}));
}

TEST_F(TraceEndTest, IsNotSwitchedOnByAnEmptyVariable) {
  setenv("MACROTASK_TRACE", "", 1);
  EXPECT_EXIT(_exit(TraceClasses() == 0 && TraceFile().empty() ? 0 : 1),
              testing::ExitedWithCode(0), "^$");
  unsetenv("MACROTASK_TRACE");
}

// Of pthreads that have recorded nothing yet; one for each task.
TEST_F(TraceEndTest, HoldsAsManyRecordsAsWereAskedFor) {
  EXPECT_EXIT(
      {
        SetTraceFile(path_);
        SetTraceSize(5);  // rounded up
        SetTraceClasses(static_cast<std::uint32_t>(TraceClass::kUsers));
        for (std::uint64_t n = 0; n < 100; ++n) RecordUser(65, n);
        ExitByItself();
      },
      testing::ExitedWithCode(0), "^$");
  const Trace trace = ReadTrace(path_);
  ASSERT_EQ(trace.buffers.size(), 1u);
  EXPECT_EQ(trace.buffers[0].num_lost, 92u);
  EXPECT_EQ(DataOf65(trace),
            (std::multiset<std::uint64_t>{92, 93, 94, 95, 96, 97, 98, 99}));
}

}  // namespace
}  // namespace macrotask
