// What a barrier of more tasks than processors does when its tasks are not all
// placed, or do not watch for long.

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <deque>
#include <thread>
#include <utility>
#include <vector>

#include "macrotask/barrier.h"
#include "macrotask/placement.h"
#include "macrotask/processor_load.h"
#include "macrotask/task.h"
#include "tests/macrotask/support.h"

namespace macrotask {
namespace {

const int kNumTasks = 3 * NumProcessors() + 1;

// Counts phases in which some task saw another one early or late.
class Phases {
 public:
  explicit Phases(Barrier& barrier)
      : barrier_(barrier),
        phase_of_(static_cast<std::size_t>(barrier.num_tasks())) {}

  void Run(int task, int num_phases) {
    for (int phase = 1; phase <= num_phases; ++phase) {
      phase_of_[static_cast<std::size_t>(task)]->store(
          phase, std::memory_order_relaxed);
      barrier_.Sync();
      for (const auto& other : phase_of_) {
        if (other->load(std::memory_order_relaxed) != phase) ++num_errors_;
      }
      barrier_.Sync();
    }
  }

  int num_errors() const { return num_errors_; }

 private:
  Barrier& barrier_;
  std::vector<CacheAligned<std::atomic<int>>> phase_of_;
  std::atomic<int> num_errors_ = 0;
};

TEST(TwoLevelBarrierTest, HoldsTasksThatAreNotPlaced) {
  Barrier barrier(kNumTasks, WaitPolicy::Hold());
  Phases phases(barrier);
  {
    std::deque<Task> tasks;
    for (int task = 1; task < kNumTasks; ++task) {
      tasks.emplace_back([&, task] { phases.Run(task, 200); });
    }
    phases.Run(0, 200);
  }
  EXPECT_EQ(phases.num_errors(), 0);
}

TEST(TwoLevelBarrierTest, HoldsPlacedOnesBesideOthers) {
  Barrier barrier(kNumTasks + 2, WaitPolicy::Hold());
  Phases phases(barrier);
  std::thread first([&] { phases.Run(kNumTasks, 200); });
  std::thread second([&] { phases.Run(kNumTasks + 1, 200); });
  RunTasks(
      kNumTasks, [&](int task) { phases.Run(task, 200); }, WaitPolicy::Hold());
  first.join();
  second.join();
  EXPECT_EQ(phases.num_errors(), 0);
}

TEST(TwoLevelBarrierTest, LosesNobodyWhoGivesUpWatching) {
  for (const int hold_time_ns : {0, 500, 5000}) {
    const auto policy =
        WaitPolicy::Hold(std::chrono::nanoseconds(hold_time_ns));
    Barrier barrier(kNumTasks, policy);
    EXPECT_EQ(CountPhaseErrors(
                  kNumTasks, 500, [&](int) { barrier.Sync(); }, policy),
              0)
        << hold_time_ns;
  }
}

// One that nobody has said the policy of is decided by whoever comes first, and
// serves all others all the same.
TEST(UndecidedBarrierTest, ServesPthreadsAndLogicalTasksInTurn) {
  Barrier first_logical(kNumTasks);
  Barrier first_pthreads(kNumTasks);
  const WaitPolicy logical = WaitPolicy::Logical(), hold = WaitPolicy::Hold();
  for (const auto& [barrier, policies] :
       {std::pair{&first_logical, std::vector{logical, hold, logical}},
        std::pair{&first_pthreads, std::vector{hold, logical, hold}}}) {
    for (const WaitPolicy& policy : policies) {
      EXPECT_EQ(CountPhaseErrors(
                    kNumTasks, 50, [&](int) { barrier->Sync(); }, policy),
                0);
    }
    EXPECT_EQ(barrier->num_waiting(), 0);
  }
}

// Both kinds in one phase must come to the same decision, whoever is first.
TEST(UndecidedBarrierTest, ServesAPthreadBesideLogicalTasks) {
  for (int round = 0; round < 20; ++round) {
    Barrier barrier(kNumTasks + 1);
    Phases phases(barrier);
    std::thread other([&] { phases.Run(kNumTasks, 5); });
    RunTasks(
        kNumTasks, [&](int task) { phases.Run(task, 5); },
        WaitPolicy::Logical());
    other.join();
    EXPECT_EQ(phases.num_errors(), 0);
  }
}

TEST(TwoLevelBarrierTest, CountsWhoWaits) {
  Barrier barrier(kNumTasks, WaitPolicy::Hold());
  RunTasks(
      kNumTasks,
      [&](int task) {
        if (task == 0) {
          YieldUntil([&] { return barrier.num_waiting() == kNumTasks - 1; });
        }
        barrier.Sync();
      },
      WaitPolicy::Hold());
  EXPECT_EQ(barrier.num_waiting(), 0);
}

// All have been counted out again, whoever slept and woke whom.
TEST(ProcessorLoadTest, IsZeroWhenNobodyRuns) {
  Barrier barrier(kNumTasks, WaitPolicy::Hold());
  for (int round = 0; round < 20; ++round) {
    RunTasks(
        kNumTasks,
        [&](int) {
          for (int phase = 0; phase < 50; ++phase) barrier.Sync();
        },
        WaitPolicy::Hold());
    int num_awake = 0;
    for (int i = 0; i < NumProcessorLoads(); ++i) {
      num_awake += LoadOfProcessor(i).num_awake.load();
    }
    ASSERT_EQ(num_awake, 0) << round;
  }
}

TEST(ProcessorLoadTest, IsThatOfTheTaskAgainAfterATaskOfItsOwn) {
  RunTasks(
      kNumTasks,
      [&](int) {
        ProcessorLoad* const before = load_of_own_processor;
        EXPECT_NE(before, nullptr);
        RunTasks(
            1, [](int) { EXPECT_EQ(load_of_own_processor, nullptr); },
            WaitPolicy::Hold());
        EXPECT_EQ(load_of_own_processor, before);
      },
      WaitPolicy::Hold());
}

}  // namespace
}  // namespace macrotask
