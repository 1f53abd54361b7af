#include "bench/predict/program.h"

#include <gtest/gtest.h>

#include <set>
#include <string_view>

namespace bench::predict {
namespace {

TaskProgram HeadBodyTail(long num_bodies) {
  return {{Compute(Block::kStart, 1), Sync(StepKind::kPost, 0)},
          {Compute(Block::kOcd, 2), Sync(StepKind::kBarrier, 0)},
          {Compute(Block::kShift, 4)},
          num_bodies};
}

std::vector<Step> StepsOf(const TaskProgram& task) {
  std::vector<Step> steps;
  task.ForEach([&](const Step& step) { steps.push_back(step); });
  return steps;
}

TEST(Name, IsAnotherOneForEachBlock) {
  std::set<std::string_view> names;
  for (int block = 0; block < kNumBlocks; ++block) {
    names.insert(Name(static_cast<Block>(block)));
  }
  EXPECT_EQ(names.size(), std::size_t{kNumBlocks});
  EXPECT_EQ(names.count(""), 0u);
}

TEST(Name, IsThatOfFigure1) {
  EXPECT_EQ(Name(Block::kStart), "start");
  EXPECT_EQ(Name(Block::kCs), "CS");
  EXPECT_EQ(Name(Block::kOcd), "OCD");
  EXPECT_EQ(Name(Block::kRma), "RMA");
  EXPECT_EQ(Name(Block::kCcd), "CCD");
  EXPECT_EQ(Name(Block::kShift), "shift");
  EXPECT_EQ(Name(Block::kOther), "other");
}

TEST(TaskProgram, ForEachRepeatsTheBodyBetweenHeadAndTail) {
  const TaskProgram task = HeadBodyTail(2);
  EXPECT_EQ(
      StepsOf(task),
      (std::vector<Step>{task.head[0], task.head[1], task.body[0], task.body[1],
                         task.body[0], task.body[1], task.tail[0]}));
}

TEST(TaskProgram, ForEachLeavesOutABodyOfNoTurns) {
  const TaskProgram task = HeadBodyTail(0);
  EXPECT_EQ(StepsOf(task),
            (std::vector<Step>{task.head[0], task.head[1], task.tail[0]}));
}

TEST(TaskProgram, ForEachOfNothingCallsNobody) {
  TaskProgram task;
  task.num_bodies = 3;
  EXPECT_TRUE(StepsOf(task).empty());
}

TEST(Work, CountsTheBodyOncePerTurn) {
  for (const long turns : {0, 1, 3}) {
    Program program;
    program.tasks = {HeadBodyTail(turns)};
    EXPECT_EQ(Work(program), 1 + 2 * static_cast<double>(turns) + 4);
  }
}

TEST(Work, IsThatOfAllTasks) {
  Program program;
  program.tasks = {HeadBodyTail(1), HeadBodyTail(3), {}};
  program.tasks[1].started = true;
  EXPECT_EQ(Work(program), 7 + 11);
}

TEST(Work, CountsBusyWorkOnTopOfTheBlock) {
  Step step = Compute(Block::kOcd, 2);
  step.busy = 0.5;
  Program program;
  program.tasks = {{{step}, {step}, {step}, 3}};
  EXPECT_EQ(Work(program), 5 * 2.5);
}

TEST(Work, IsNothingWithoutTasks) { EXPECT_EQ(Work({}), 0); }

TEST(Work, IsComputingAlone) {
  Step step = Sync(StepKind::kWait, 0);
  step.seconds = 8;
  step.busy = 8;
  Program program;
  program.tasks = {{{step}, {step}, {step}, 2}};
  EXPECT_EQ(Work(program), 0);
}

TEST(WorkByBlock, KeepsBlocksApart) {
  Program program;
  program.tasks = {HeadBodyTail(3), HeadBodyTail(1)};
  const std::array<double, kNumBlocks> expected = {2, 0, 8, 0, 0, 8, 0};
  EXPECT_EQ(WorkByBlock(program), expected);
}

TEST(WorkByBlock, AddsUpToWork) {
  Program program;
  program.tasks = {HeadBodyTail(5)};
  double sum = 0;
  for (const double seconds : WorkByBlock(program)) sum += seconds;
  EXPECT_EQ(sum, Work(program));
}

}  // namespace
}  // namespace bench::predict
