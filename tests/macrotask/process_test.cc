// What a whole process sees of the tasks: its end, and the limits that the
// system sets it. Every test has a process of its own.

#include "tests/macrotask/process.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <system_error>

#include "macrotask/event.h"
#include "macrotask/task.h"

namespace macrotask {
namespace {

using ProcessTest = InOwnProcess<testing::Test>;

using ProcessEndTest = ProcessTest;

TEST_F(ProcessEndTest, JoinsIdlePthreads) {
  EXPECT_EXIT(
      {
        RunTasks(
            16, [](int) {}, WaitPolicy::Hold());
        std::exit(0);
      },
      testing::ExitedWithCode(0), "");
}

TEST_F(ProcessEndTest, LeavesATaskThatNeverReturns) {
  EXPECT_EXIT(
      {
        // Not destroyed: a task still waits for them.
        static Event& never = *new Event;
        static Event& running = *new Event;
        static Task* const for_ever = new Task([] {
          running.Post();
          never.Wait();
        });
        running.Wait();
        std::exit(for_ever->Test() ? 0 : 1);
      },
      testing::ExitedWithCode(0), "");
}

TEST_F(ProcessEndTest, LetsAStaticObjectRunTasksAtItsEnd) {
  EXPECT_EXIT(
      {
        struct Late {
          ~Late() {
            RunTasks(
                3, [](int) {}, WaitPolicy::Hold());
            std::fputs("late", stderr);
          }
        };
        static Late destroyed_after_the_pool;
        RunTasks(
            2, [](int) {}, WaitPolicy::Hold());
        std::exit(0);
      },
      testing::ExitedWithCode(0), "late");
}

TEST_F(ProcessEndTest, ATaskMayEndTheProcess) {
  EXPECT_EXIT(RunTasks(
                  4,
                  [](int task) {
                    if (task == 2) std::exit(3);
                    Event never;
                    never.Wait();
                  },
                  WaitPolicy::Hold()),
              testing::ExitedWithCode(3), "");
}

using ThreadLimitTest = ProcessTest;

// Leaves room for a few dozen stacks. A limit on the number of threads itself
// does not bind root.
void LimitAddressSpace() {
  long num_pages = 0;
  std::ifstream("/proc/self/statm") >> num_pages;
  rlimit limit;
  getrlimit(RLIMIT_AS, &limit);
  limit.rlim_cur = static_cast<rlim_t>(num_pages * sysconf(_SC_PAGESIZE)) +
                   (rlim_t{256} << 20);
  setrlimit(RLIMIT_AS, &limit);
}

[[maybe_unused]] void RunTooManyTasks() {
  int num_runs = 0;
  LimitAddressSpace();
  try {
    RunTasks(
        10000, [&](int) { ++num_runs; }, WaitPolicy::Hold());
  } catch (const std::system_error& error) {
    std::fprintf(stderr, "<%s>", error.what());
    if (error.code() != std::errc::resource_unavailable_try_again) return;
  }
  RunTasks(
      3, [](int) {},
      WaitPolicy::Hold());  // The threads obtained have been given back.
  std::exit(num_runs == 0 ? 0 : 1);
}

// The sanitizers reserve address space of their own and cannot live within a
// limit on it.
TEST_F(ThreadLimitTest, IsReportedInOneSentenceBeforeAnyBodyStarts) {
#ifdef MACROTASK_SANITIZED
  GTEST_SKIP() << "a limit on the address space stops the sanitizer itself";
#else
  EXPECT_EXIT(RunTooManyTasks(), testing::ExitedWithCode(0),
              "<cannot start 10000 tasks: the system allows no more threads "
              "after [0-9]+ \\(Resource temporarily unavailable\\)>");
#endif
}

}  // namespace
}  // namespace macrotask
