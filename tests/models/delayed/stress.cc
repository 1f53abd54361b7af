// stress <seconds> <patience in seconds> [seed]
//
// Every construct, every policy, random numbers of tasks and processors, with
// random delays between the steps of the library (delays.h). Exits with 1 if a
// task sees what it must not see, or if a program takes longer than the
// patience; with 3, which is the library's, if that finds a deadlock. The seed
// fixes what is done, not how the tasks happen to run.

#include <signal.h>
#include <unistd.h>

#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <deque>
#include <iostream>
#include <iterator>
#include <memory>
#include <vector>

#include "macrotask/barrier.h"
#include "macrotask/cache_line.h"
#include "macrotask/epoch.h"
#include "macrotask/event.h"
#include "macrotask/lock.h"
#include "macrotask/placement.h"
#include "macrotask/task.h"
#include "macrotask/wait_policy.h"

namespace macrotask {
namespace {

std::uint64_t Below(std::uint64_t limit) { return delayed::Random() % limit; }

std::size_t Index(int i) { return static_cast<std::size_t>(i); }

// What a program of this round is made of.
struct Setting {
  int num_tasks;
  int num_rounds;
  WaitPolicy policy;
};

WaitPolicy AnyPolicy() {
  switch (Below(5)) {
    case 0:
      return WaitPolicy::Block();
    case 1:
      return WaitPolicy::Spin();
    case 2:
      return WaitPolicy::Logical();
    case 3:
      return WaitPolicy::Hold(std::chrono::microseconds(Below(50)));
    default:
      return WaitPolicy::Hold();
  }
}

void Expect(bool is_true, const char* what) {
  if (is_true) return;
  std::cout << "stress: " << what << std::endl;
  std::_Exit(1);
}

BarrierAlgorithm AnyAlgorithm() {
  constexpr BarrierAlgorithm kAlgorithms[] = {BarrierAlgorithm::kAuto,
                                              BarrierAlgorithm::kDissemination,
                                              BarrierAlgorithm::kTree};
  return kAlgorithms[Below(std::size(kAlgorithms))];
}

// The slots are not atomic: AddressSanitizer and ThreadSanitizer look on.
void Barriers(const Setting& setting) {
  Barrier barrier(setting.num_tasks, setting.policy, AnyAlgorithm());
  const bool are_members = Below(3) > 0;
  std::vector<CacheAligned<int>> phase_of(Index(setting.num_tasks));
  RunTasks(
      setting.num_tasks,
      [&](int task) {
        for (int phase = 1; phase <= setting.num_rounds; ++phase) {
          *phase_of[Index(task)] = phase;
          are_members ? barrier.Sync(task) : barrier.Sync();
          for (const auto& other : phase_of) {
            Expect(*other == phase, "a barrier has let a task go too soon");
          }
          barrier.Sync();
        }
      },
      setting.policy);
}

void Locks(const Setting& setting) {
  Lock lock(setting.policy);
  int num_turns = 0;
  RunTasks(
      setting.num_tasks,
      [&](int) {
        for (int round = 0; round < setting.num_rounds; ++round) {
          if (Below(4) == 0) {
            while (lock.Test()) {
            }
          } else {
            lock.On();
          }
          const int seen = num_turns;
          delayed::Delay();
          num_turns = seen + 1;
          lock.Off();
        }
      },
      setting.policy);
  Expect(num_turns == setting.num_tasks * setting.num_rounds,
         "two tasks have held a lock");
  Expect(!lock.is_set() && lock.num_waiting() == 0, "a lock is left set");
}

// One task writes and posts, another one waits, clears and reads, and answers
// by an event. The rest wait for one that is posted and cleared at once: those
// that wait then are released, and for the others the last post stays.
void Events(const Setting& setting) {
  Event written(setting.policy), taken(setting.policy), over(setting.policy);
  int item = 0;
  RunTasks(
      setting.num_tasks + 1,
      [&](int task) {
        if (task >= 2) return over.Wait();
        for (int round = 1; round <= setting.num_rounds; ++round) {
          if (task == 0) {
            item = round;
            written.Post();
            taken.Wait();
            taken.Clear();
          } else {
            written.Wait();
            written.Clear();
            Expect(item == round, "an event has come before what it tells");
            over.Post();
            over.Clear();
            taken.Post();
          }
        }
        if (task == 0) over.Post();
      },
      setting.policy);
}

// Whom an advance has released destroys the epoch.
void Epochs(const Setting& setting) {
  for (int round = 0; round < setting.num_rounds; ++round) {
    auto epoch = std::make_unique<Epoch>();
    Epoch& alias = *epoch;
    int written = 0;
    RunTasks(
        2,
        [&](int task) {
          if (task == 0) {
            written = 1;
            alias.Advance();
          } else {
            alias.AwaitPast(0, setting.policy);
            Expect(written == 1, "an epoch has come before what it tells");
            epoch.reset();
          }
        },
        setting.policy);
  }
}

// Tasks that start tasks, and others that come on the pthreads of those that
// have just ended.
void Tasks(const Setting& setting) {
  const TaskOptions options{.wait = setting.policy};
  for (int round = 0; round < setting.num_rounds; ++round) {
    std::vector<CacheAligned<int>> done(Index(setting.num_tasks));
    std::deque<Task> tasks;
    for (int i = 0; i < setting.num_tasks; ++i) {
      tasks.emplace_back(
          [&, i] {
            Task inner([&, i] { *done[Index(i)] += 1; }, options);
            inner.Wait();
            *done[Index(i)] += 1;
          },
          options);
    }
    for (Task& task : tasks) task.Wait();
    for (const auto& slot : done) {
      Expect(*slot == 2, "a task has ended before its work");
    }
  }
}

void GiveUp(int) {
  static constexpr char kText[] = "stress: a task waits for ever\n";
  [[maybe_unused]] const auto n = write(STDOUT_FILENO, kText, sizeof kText - 1);
  std::_Exit(1);
}

int Main(int argc, char** argv) {
  if (argc < 3) {
    std::cerr << "stress <seconds> <patience in seconds> [seed]" << std::endl;
    return 2;
  }
  const std::chrono::seconds time(std::atoi(argv[1]));
  signal(SIGALRM, &GiveUp);
  const auto patience = static_cast<unsigned>(std::atoi(argv[2]));
  const auto seed = argc > 3 ? std::strtoull(argv[3], nullptr, 10) : 1;
  delayed::seed = seed;
  static constexpr void (*kPrograms[])(const Setting&) = {
      &Barriers, &Locks, &Events, &Epochs, &Tasks};
  const auto end = std::chrono::steady_clock::now() + time;
  int num_programs = 0;
  for (; std::chrono::steady_clock::now() < end; ++num_programs) {
    const auto num_tasks = 1 + static_cast<int>(Below(6));
    const auto num_rounds = 1 + static_cast<int>(Below(30));
    // Seldom one for each task: barriers then have two levels.
    SetMaxProcessors(1 + static_cast<int>(Below(4)));
    alarm(patience);
    kPrograms[Below(std::size(kPrograms))](
        {num_tasks, num_rounds, AnyPolicy()});
  }
  std::cout << "stress: " << num_programs << " programs, seed " << seed
            << ", nothing found" << std::endl;
  return 0;
}

}  // namespace
}  // namespace macrotask

int main(int argc, char** argv) { return macrotask::Main(argc, argv); }
