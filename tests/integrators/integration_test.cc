#include "integrators/integration.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "tests/support/model_system.h"

namespace integrators {
namespace {

using support::ModelSystem;

template <typename Function>
std::string MessageOf(Function function) {
  try {
    function();
  } catch (const std::exception& error) {
    return error.what();
  }
  return "";
}

std::string MessageFor(const ModelSystem& model,
                       const IntegrationOptions& options) {
  return MessageOf([&] { Integration integration(model, options); });
}

TEST(Integration, PartitionLargerThanChainsOrPointsIsNamed) {
  const ModelSystem model(3);
  EXPECT_EQ(MessageFor(model, {.step = 0.1,
                               .num_steps = 10,
                               .figure = Figure::kFigure8,
                               .partition = {4, 1}}),
            "4 chain tasks: expected 1 to 3, the number of chains");
  EXPECT_EQ(MessageFor(model, {.method = B2PC5(),
                               .step = 0.1,
                               .num_steps = 10,
                               .figure = Figure::kFigure8,
                               .partition = {1, 3}}),
            "3 integration tasks: expected 1 to 2, the points of a block of "
            "B2PC5");
  EXPECT_NE(MessageFor(model, {.step = 0.1,
                               .num_steps = 10,
                               .figure = Figure::kFigure8,
                               .partition = {0, 1}}),
            "");
}

TEST(Integration, PartitionThatTheFigureDoesNotHaveIsNamed) {
  const ModelSystem model(4);
  const auto message = [&](Figure figure, Partition partition) {
    return MessageFor(model, {.method = B4PC5(),
                              .step = 0.1,
                              .num_steps = 10,
                              .figure = figure,
                              .partition = partition});
  };
  EXPECT_EQ(message(Figure::kSerial, {2, 1}),
            "serial has one task: got 2 chain tasks and 1 integration tasks");
  EXPECT_EQ(message(Figure::kFigure2, {1, 2}),
            "figure2 is parallel over the chains only: got 1 chain tasks and 2 "
            "integration tasks");
  EXPECT_NE(message(Figure::kFigure3, {2, 2}), "");
  EXPECT_EQ(message(Figure::kFigure7, {2, 2}),
            "figure7 is parallel over the block points only: got 2 chain tasks "
            "and 2 integration tasks");
}

TEST(Integration, TooFewStepsAreNamed) {
  EXPECT_EQ(MessageFor(ModelSystem(1),
                       {.method = B4PC5(), .step = 0.1, .num_steps = 7}),
            "7 steps: B4PC5 needs at least 8");
}

TEST(Integration, InitialStateOfAnotherSizeIsNamed) {
  const ModelSystem model(1);
  Integration integration(model, {.step = 0.1, .num_steps = 10});
  EXPECT_EQ(MessageOf([&] {
              integration.Run({1, 2, 3});
            }),
            "the initial state has 3 numbers: expected 4");
}

TEST(Integration, CountsTheStepsThatDivideTheDuration) {
  EXPECT_EQ(CountSteps(1, 0.01), 100);
  EXPECT_EQ(CountSteps(1, 1.0 / 115), 115);
  EXPECT_EQ(MessageOf([] { CountSteps(1, 0.03); }),
            "the step of 0.03 s does not divide the duration of 1 s");
  EXPECT_EQ(MessageOf([] { CountSteps(1, 0); }),
            "the step must be positive, not 0 s");
  EXPECT_EQ(MessageOf([] { CountSteps(1, 1e-7); }),
            "the step of 1e-07 s makes more than a million steps");
  EXPECT_NE(MessageOf([] { CountSteps(1, -0.1); }), "");
  EXPECT_NE(MessageOf([] { CountSteps(1, std::nan("")); }), "");
  EXPECT_NE(MessageOf([] { CountSteps(1, 2); }), "");
}

TEST(Integration, EvaluatesEveryPointTwiceAndTheStartBesides) {
  const ModelSystem model(2);
  for (const BlockMethod& method : {B1PC5(), B2PC5(), B4PC5()}) {
    for (int steps = 12; steps <= 16; ++steps) {
      Integration integration(
          model, {.method = method, .step = 0.01, .num_steps = steps});
      const int start = BlockRun::NumStartSteps(method, steps);
      EXPECT_GE(start, 4);
      EXPECT_LT(start, 4 + method.block_size);
      EXPECT_EQ(integration.Run(model.Solution(0)).evaluations,
                1 + 6 * start + 2 * (steps - start));
    }
  }
}

TEST(Integration, EndsAtTheEndWhateverIsLeftOverOfABlock) {
  const ModelSystem model(2);
  for (int steps = 40; steps < 44; ++steps) {
    const double h = 1.0 / steps;
    Integration integration(model,
                            {.method = B4PC5(), .step = h, .num_steps = steps});
    const auto state = integration.Run(model.Solution(0)).state;
    const auto solution = model.Solution(1);
    for (std::size_t e = 0; e < solution.size(); ++e) {
      EXPECT_NEAR(state[e], solution[e], 1e-6) << steps;
    }
  }
}

TEST(Integration, RecordsTheStateOfEveryGridPoint) {
  const ModelSystem model(3);
  constexpr int kSteps = 30;
  Integration integration(model, {.method = B4PC5(),
                                  .step = 0.02,
                                  .num_steps = kSteps,
                                  .figure = Figure::kFigure8,
                                  .partition = {2, 2},
                                  .record = true});
  const IntegrationResult result = integration.Run(model.Solution(0));
  const std::size_t size = integration.layout().size();
  ASSERT_EQ(integration.trajectory().size(), (kSteps + 1) * size);
  for (int n = 0; n <= kSteps; ++n) {
    const auto solution = model.Solution(0.02 * n);
    for (std::size_t e = 0; e < size; ++e) {
      EXPECT_NEAR(
          integration.trajectory()[static_cast<std::size_t>(n) * size + e],
          solution[e], 1e-6);
    }
  }
  EXPECT_TRUE(std::equal(
      result.state.begin(), result.state.end(),
      integration.trajectory().end() - static_cast<std::ptrdiff_t>(size)));
}

TEST(Integration, RunsAgainAfterAFailure) {
  const ModelSystem model(
      2, {.kind = ModelSystem::Fault::kThrows, .chain = 1, .time = 0.5});
  Integration integration(model, {.step = 0.1, .num_steps = 10});
  for (int run = 0; run < 3; ++run) {
    EXPECT_EQ(MessageOf([&] { integration.Run(model.Solution(0)); }),
              "chain throws");
  }
}

TEST(Integration, FailureInTheStartIsReportedWithItsTime) {
  const ModelSystem model(
      2, {.kind = ModelSystem::Fault::kFails, .chain = 1, .time = 0.15});
  Integration integration(model, {.step = 0.1,
                                  .num_steps = 10,
                                  .figure = Figure::kFigure3,
                                  .partition = {2, 1}});
  // DOPRI5's stage at 0.1 + 4/5 0.1.
  EXPECT_EQ(MessageOf([&] { integration.Run(model.Solution(0)); }),
            "chain 1 fails at t = 0.180000 s");
}

}  // namespace
}  // namespace integrators
