// The programs that are read off the figures themselves.

#include "bench/predict/figure_program.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "bench/predict/figure_costs.h"
#include "bench/predict/simulation.h"

namespace bench::predict {
namespace {

using integrators::Figure;
using integrators::Partition;

constexpr int kBlocks = 5;

FigureCase CaseOf(const integrators::BlockMethod& method, Figure figure,
                  Partition partition, int num_blocks = kBlocks) {
  return {.method = method,
          .figure = figure,
          .partition = partition,
          .num_chains = 4,
          .num_steps = method.num_values - 1 + num_blocks * method.block_size};
}

// "CS OCD barrier0 RMA CCD ...": what a task does in the body of its program.
std::string BodyText(const TaskProgram& task) {
  std::string text;
  for (const Step& step : task.body) {
    constexpr std::array<const char*, 9> kNames = {
        "compute", "barrier", "post",  "wait", "clear",
        "lock",    "unlock",  "start", "join"};
    if (!text.empty()) text += ' ';
    if (step.kind == StepKind::kCompute) {
      text += Name(step.block);
    } else {
      text += kNames[static_cast<std::size_t>(step.kind)];
    }
  }
  return text;
}

long Count(const Program& program, StepKind kind, Block block) {
  long count = 0;
  for (const TaskProgram& task : program.tasks) {
    task.ForEach([&](const Step& step) {
      const bool same = step.kind == kind &&
                        (kind != StepKind::kCompute || step.block == block);
      count += same;
    });
  }
  return count;
}

TEST(ReadFigure, SerialProgramDoesTheBlocksOfFigure1Twice) {
  const Program program =
      ReadFigure(CaseOf(integrators::B1PC5(), Figure::kSerial, {1, 1}));
  ASSERT_EQ(program.num_tasks(), 1);
  EXPECT_EQ(BodyText(program.tasks[0]), "CS OCD RMA CCD CS OCD RMA CCD");
  EXPECT_EQ(Count(program, StepKind::kCompute, Block::kOcd), 2 * kBlocks);
  EXPECT_EQ(Count(program, StepKind::kCompute, Block::kStart), 1);
}

TEST(ReadFigure, Figure2HasOneTaskForRma) {
  const Program program =
      ReadFigure(CaseOf(integrators::B1PC5(), Figure::kFigure2, {2, 1}));
  ASSERT_EQ(program.num_tasks(), 2);
  EXPECT_EQ(BodyText(program.tasks[0]),
            "CS OCD barrier clear RMA post CCD "
            "CS OCD barrier clear RMA post CCD");
  EXPECT_EQ(BodyText(program.tasks[1]),
            "CS OCD barrier wait CCD CS OCD barrier wait CCD");
}

TEST(ReadFigure, Figure3HasOneSynchronizationAnEvaluation) {
  const Program program =
      ReadFigure(CaseOf(integrators::B1PC5(), Figure::kFigure3, {4, 1}));
  for (const TaskProgram& task : program.tasks) {
    EXPECT_EQ(BodyText(task), "CS OCD barrier RMA CCD CS OCD barrier RMA CCD");
  }
}

TEST(ReadFigure, Figure7ShiftsInItsFirstTask) {
  const Program program =
      ReadFigure(CaseOf(integrators::B4PC5(), Figure::kFigure7, {1, 4}));
  ASSERT_EQ(program.num_tasks(), 4);
  EXPECT_EQ(BodyText(program.tasks[0]),
            "CS OCD RMA CCD barrier clear CS OCD RMA CCD barrier shift post");
  for (std::size_t t = 1; t < 4; ++t) {
    EXPECT_EQ(BodyText(program.tasks[t]),
              "CS OCD RMA CCD barrier CS OCD RMA CCD barrier wait");
  }
}

TEST(ReadFigure, Figure8JoinsChainsThenPoints) {
  const Program program =
      ReadFigure(CaseOf(integrators::B4PC5(), Figure::kFigure8, {4, 4}));
  ASSERT_EQ(program.num_tasks(), 16);
  EXPECT_EQ(BodyText(program.tasks[0]),
            "CS OCD barrier RMA CCD barrier clear "
            "CS OCD barrier RMA CCD barrier shift post");
  EXPECT_EQ(BodyText(program.tasks[15]),
            "CS OCD barrier RMA CCD barrier CS OCD barrier RMA CCD barrier "
            "wait");
  // A barrier for each point and each chain, and that of all tasks.
  EXPECT_EQ(program.barriers.size(), 9u);
  EXPECT_EQ(program.num_events, 4);
}

TEST(ReadFigure, HasAllBlocksOfAnyNumber) {
  for (const int blocks : {1, 2, 3, 4, 29}) {
    const Program program = ReadFigure(
        CaseOf(integrators::B2PC5(), Figure::kFigure8, {2, 2}, blocks));
    EXPECT_EQ(Count(program, StepKind::kCompute, Block::kOcd),
              2L * blocks * program.num_tasks());
    EXPECT_EQ(Count(program, StepKind::kPost, Block::kOther), 2L * blocks);
  }
}

TEST(ReadFigure, CanHaveAThousandTasks) {
  FigureCase many = CaseOf(integrators::B4PC5(), Figure::kFigure8, {256, 4}, 2);
  many.num_chains = 256;
  const Program program = ReadFigure(many);
  EXPECT_EQ(program.num_tasks(), 1024);
  EXPECT_EQ(Count(program, StepKind::kCompute, Block::kCcd), 2L * 2 * 1024);
}

TEST(ReadFigure, RejectsWhatAnIntegrationRejects) {
  EXPECT_THROW(
      ReadFigure(CaseOf(integrators::B1PC5(), Figure::kFigure3, {5, 1})),
      std::invalid_argument);
  EXPECT_THROW(
      ReadFigure(CaseOf(integrators::B2PC5(), Figure::kFigure7, {2, 1})),
      std::invalid_argument);
}

TEST(CountsOf, DivideTheWorkAmongTheTasks) {
  const FigureCase figure_case =
      CaseOf(integrators::B4PC5(), Figure::kFigure8, {2, 4});
  double pairs = 0;
  for (int task = 0; task < 8; ++task) {
    pairs += CountsOf(Block::kOcd, figure_case, {}, 1, task, 8).items;
  }
  EXPECT_EQ(pairs, 16);
  const Counts four_lanes = CountsOf(Block::kOcd, figure_case, {}, 4, 0, 8);
  EXPECT_EQ(four_lanes.packs, 1);
  EXPECT_EQ(four_lanes.items, 2);
}

TEST(CountsOf, LinesAreThoseOfOtherProcessors) {
  const FigureCase figure_case =
      CaseOf(integrators::B4PC5(), Figure::kFigure8, {2, 4});
  const SystemSizes sizes;
  // Alone on its processor: the tips of two chains at its point, and the
  // derivatives of two chains and the member, 37 doubles, at three points.
  EXPECT_EQ(CountsOf(Block::kRma, figure_case, sizes, 1, 0, 8).lines,
            2 * sizes.tip_lines);
  EXPECT_EQ(CountsOf(Block::kCs, figure_case, sizes, 1, 0, 8).lines, 3 * 5);
  // All tasks on one.
  EXPECT_EQ(CountsOf(Block::kRma, figure_case, sizes, 1, 0, 1).lines, 0);
  EXPECT_EQ(CountsOf(Block::kCs, figure_case, sizes, 1, 0, 1).lines, 0);
}

TEST(SetCosts, TotalWorkDoesNotDependOnThePartition) {
  BlockCosts blocks;
  blocks[static_cast<std::size_t>(Block::kOcd)] = {.item = 0x1p-10};
  for (const Partition partition : {Partition{1, 1}, {2, 2}, {4, 1}, {4, 4}}) {
    const FigureCase figure_case =
        CaseOf(integrators::B4PC5(), Figure::kFigure8, partition);
    Program program = ReadFigure(figure_case);
    SetCosts(figure_case, {}, blocks, {.num_lanes = 1, .work = 0x1p-10},
             &program);
    EXPECT_EQ(Work(program), 2 * 16 * 2 * kBlocks * 0x1p-10);
  }
}

TEST(SetCosts, SimulatedTimeOfFigure8WithFreeWaitingIsTheLongestShare) {
  BlockCosts blocks;
  blocks[static_cast<std::size_t>(Block::kOcd)] = {.item = 1};
  const FigureCase figure_case =
      CaseOf(integrators::B4PC5(), Figure::kFigure8, {4, 4});
  Program program = ReadFigure(figure_case);
  SetCosts(figure_case, {}, blocks, {.num_lanes = 1}, &program);
  SimulationOptions options;
  options.processors = 16;
  EXPECT_EQ(Simulate(program, options).seconds, 2 * kBlocks);
  options.processors = 4;
  EXPECT_EQ(Simulate(program, options).seconds, 4 * 2 * kBlocks);
}

}  // namespace
}  // namespace bench::predict
