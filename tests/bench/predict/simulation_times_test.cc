#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <random>

#include "bench/predict/simulation.h"
#include "tests/bench/predict/programs.h"

namespace bench::predict {
namespace {

// A phase: every task computes, maybe with a lock, posts its own event, maybe
// waits for one that somebody posts in the same phase, and meets all others.
// Nobody waits before its post, so that all of it ends. `unit` s scales it.
class RandomProgram {
 public:
  explicit RandomProgram(std::uint64_t seed, double unit = 1)
      : random_(seed), unit_(unit), n_(kTaskCounts[random_() % 6]) {
    program_ = Phases(n_, 0, 0);
    program_.num_locks = 2;
    const int phases = 1 + static_cast<int>(random_() % 4);
    program_.num_events = phases * n_;
    for (int phase = 0; phase < phases; ++phase) {
      for (int t = 0; t < n_; ++t) AddPhase(t, phase * n_);
    }
  }

  const Program& program() const { return program_; }

  SimulationOptions RandomOptions() {
    const auto draw = [this] { return unit_ * Draw(&random_); };
    WaitCost wait = {.barrier = {.two = draw(), .further = draw()}};
    for (double WaitCost::*cost :
         {&WaitCost::event, &WaitCost::post, &WaitCost::lock,
          &WaitCost::sleeps_after, &WaitCost::wake, &WaitCost::waker,
          &WaitCost::turn, &WaitCost::shared_wake}) {
      wait.*cost = draw();
    }
    const auto most = static_cast<std::uint64_t>(n_ + 2);
    return On(1 + static_cast<int>(random_() % most), wait,
              random_() % 2 ? TaskPlacement::kFree : TaskPlacement::kPinned);
  }

 private:
  void AddPhase(int t, int first_event) {
    auto& steps = program_.tasks[static_cast<std::size_t>(t)].head;
    const auto add_work = [&] {
      Step work = Compute(static_cast<Block>(random_() % kNumBlocks),
                          unit_ * Draw(&random_));
      if (random_() % 4 == 0) work.busy = unit_ * Draw(&random_);
      steps.push_back(work);
    };
    add_work();
    if (random_() % 2) {
      const int lock = static_cast<int>(random_() % 2);
      steps.push_back(Sync(StepKind::kLock, lock));
      add_work();
      steps.push_back(Sync(StepKind::kUnlock, lock));
    }
    steps.push_back(Post(first_event + t));
    const auto other = static_cast<int>(random_() % 32);
    if (other < n_) steps.push_back(Wait(first_event + other));
    add_work();
    steps.push_back(Barrier());
  }

  std::mt19937_64 random_;
  double unit_;
  int n_;
  Program program_;
};

double WorkOf(const TaskProgram& task) {
  Program alone;
  alone.tasks = {task};
  return Work(alone);
}

TEST(TaskTimes, AddUpToTheRunExactlyWhereDurationsDo) {
  for (std::uint64_t seed = 1; seed <= 500; ++seed) {
    RandomProgram random(seed);
    SCOPED_TRACE(seed);
    Simulated(random.program(), random.RandomOptions());
  }
}

// A wait makes the most sums of all steps, eight: the clock and `sync` for its
// latency and for a turn, a difference and a sum each for `imbalance` and
// `queue`. Six more are in `absent` and total(). Each rounds by at most half an
// epsilon of the whole.
TEST(TaskTimes, AddUpToTheRunWithinTheRoundingOfTheirSteps) {
  for (std::uint64_t seed = 1; seed <= 500; ++seed) {
    RandomProgram random(seed, 1e-3 / 3);
    const auto result = Simulate(random.program(), random.RandomOptions());
    for (std::size_t t = 0; t < result.tasks.size(); ++t) {
      const auto steps =
          static_cast<double>(random.program().tasks[t].head.size());
      EXPECT_NEAR(result.tasks[t].total(), result.seconds,
                  4 * (steps + 1) * std::numeric_limits<double>::epsilon() *
                      result.seconds)
          << "seed " << seed;
    }
  }
}

TEST(TaskTimes, ComputeIsTheWorkOfTheProgram) {
  for (std::uint64_t seed = 1; seed <= 500; ++seed) {
    RandomProgram random(seed);
    const auto result = Simulated(random.program(), random.RandomOptions());
    for (std::size_t t = 0; t < result.tasks.size(); ++t) {
      EXPECT_EQ(result.tasks[t].compute, WorkOf(random.program().tasks[t]))
          << "seed " << seed;
    }
  }
}

TEST(TaskTimes, NoneIsNegative) {
  for (std::uint64_t seed = 1; seed <= 500; ++seed) {
    RandomProgram random(seed);
    const auto result = Simulated(random.program(), random.RandomOptions());
    for (std::size_t t = 0; t < result.tasks.size(); ++t) {
      for (const double part : Of(result, t)) EXPECT_GE(part, 0) << seed;
    }
  }
}

TEST(Simulate, NoRunIsShorterThanItsWorkOnAllProcessorsOrItsLongestTask) {
  for (std::uint64_t seed = 1; seed <= 500; ++seed) {
    RandomProgram random(seed);
    const SimulationOptions options = random.RandomOptions();
    const auto result = Simulated(random.program(), options);
    EXPECT_GE(result.seconds * options.processors, Work(random.program()));
    for (const TaskProgram& task : random.program().tasks) {
      EXPECT_GE(result.seconds, WorkOf(task)) << "seed " << seed;
    }
  }
}

TEST(Simulate, OneProcessorWithoutCostsIsNeverIdle) {
  for (std::uint64_t seed = 1; seed <= 500; ++seed) {
    const RandomProgram random(seed);
    EXPECT_EQ(Simulated(random.program(), On(1)).seconds,
              Work(random.program()));
  }
}

}  // namespace
}  // namespace bench::predict
