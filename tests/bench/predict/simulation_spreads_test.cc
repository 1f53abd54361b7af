#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>

#include "bench/predict/simulation.h"
#include "tests/bench/predict/programs.h"

namespace bench::predict {
namespace {

SimulationOptions Spreading(const Spread& spread, std::uint64_t seed,
                            int processors = 4) {
  SimulationOptions options = On(processors, kSleepy);
  options.spreads.fill(spread);
  options.seed = seed;
  return options;
}

TEST(Simulate, SameSeedGivesTheSameDoubles) {
  const Program program = Phases(7, 20, 0.1);
  const Spread spread = {0.9, 1, 1.7};
  ExpectSame(Simulate(program, Spreading(spread, 5)),
             Simulate(program, Spreading(spread, 5)));
}

TEST(Simulate, AnotherSeedGivesOthers) {
  const Program program = Phases(7, 20, 0.1);
  const Spread spread = {0.9, 1, 1.7};
  const auto one = Simulate(program, Spreading(spread, 5));
  const auto other = Simulate(program, Spreading(spread, 6));
  EXPECT_NE(one.seconds, other.seconds);
  for (std::size_t t = 0; t < one.tasks.size(); ++t) {
    EXPECT_NE(one.tasks[t].compute, other.tasks[t].compute);
    EXPECT_NE(one.tasks[t].compute, one.tasks[(t + 1) % 7].compute);
  }
}

TEST(Simulate, SeedDoesNotMatterWithoutSpreads) {
  const Program program = Phases(7, 20, 0.1);
  ExpectSame(Simulate(program, Spreading({}, 5)),
             Simulate(program, Spreading({}, 6)));
}

TEST(Simulate, WhatATaskDrawsDoesNotDependOnTheProcessors) {
  const Program program = Phases(4, 20, 0.1);
  const auto four = Simulate(program, Spreading({0.9, 1, 1.7}, 5, 4));
  const auto one = Simulate(program, Spreading({0.9, 1, 1.7}, 5, 1));
  for (std::size_t t = 0; t < 4; ++t) {
    EXPECT_EQ(four.tasks[t].compute, one.tasks[t].compute);
  }
}

TEST(Simulate, SpreadOfOneRatioScalesExactly) {
  for (const Spread& spread : {Spread{2}, Spread{2, 2}, Spread{2, 2, 2}}) {
    EXPECT_EQ(Simulated(Phases(3, 5, 1), Spreading(spread, 9)).tasks[0].compute,
              10);
  }
}

TEST(Simulate, SpreadIsThatOfTheBlock) {
  SimulationOptions options = On(1);
  options.spreads[static_cast<std::size_t>(Block::kRma)] = {4};
  const auto result = Simulated(
      Tasks({{Compute(Block::kRma, 1), Compute(Block::kOcd, 1)}}), options);
  EXPECT_EQ(result.seconds, 5);
}

Step WithBusyWork(Block block, double seconds, double busy) {
  Step step = Compute(block, seconds);
  step.busy = busy;
  return step;
}

TEST(Simulate, BusyWorkVariesAsOtherWork) {
  SimulationOptions options = On(1);
  options.spreads[static_cast<std::size_t>(Block::kOcd)] = {4};
  const Program program = Tasks({{WithBusyWork(Block::kOcd, 1, 0.5)}});
  EXPECT_EQ(Simulated(program, options).seconds, 4 + 0.5);
  options.spreads[static_cast<std::size_t>(Block::kOther)] = {16};
  EXPECT_EQ(Simulated(program, options).seconds, 4 + 8);
}

TEST(Simulate, BusyWorkIsDrawnApartFromItsBlock) {
  const SimulationOptions options = Spreading({0.9, 1, 1.7}, 5);
  const auto both =
      Simulate(Tasks({{WithBusyWork(Block::kOcd, 1, 1)}}), options);
  const auto apart = Simulate(Tasks({{Busy(1), Busy(1)}}), options);
  const auto one = Simulate(Tasks({{Busy(1)}}), options);
  EXPECT_EQ(both.seconds, apart.seconds);
  EXPECT_NE(both.seconds, 2 * one.seconds);
}

TEST(Simulate, NothingIsDrawnForWhatTakesNoTime) {
  const SimulationOptions options = Spreading({0.9, 1, 1.7}, 5);
  const auto result = Simulate(
      Tasks({{WithBusyWork(Block::kOcd, 0, 1), Busy(0), Busy(1)}}), options);
  EXPECT_EQ(result.seconds,
            Simulate(Tasks({{Busy(1), Busy(1)}}), options).seconds);
}

// Half of the ratios are spread evenly over 0.5 to 1, half over 1 to 3: 1.375
// on average, with a standard deviation of 0.75 (variances: 0.02 and 0.33 of
// the halves, averaged, and 0.39 between them). That of the mean of 4096: 0.012.
TEST(Simulate, RatiosFollowTheQuantilesOfTheirSpread) {
  Program program = Tasks({{}});
  program.tasks[0] = {{}, {Busy(1)}, {}, 4096};
  const double mean =
      Simulate(program, Spreading({0.5, 1, 3}, 1)).seconds / 4096;
  EXPECT_NEAR(mean, 1.375, 4 * 0.012);
}

}  // namespace
}  // namespace bench::predict
