#include "bench/predict/machine.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

namespace bench::predict {
namespace {

using macrotask::WaitKind;

// Whole numbers: the sums below are exact.
constexpr BarrierCost kAllAlgorithms = {
    .two = 8, .further = 1, .round = 100, .level = 1000};

template <typename Function>
std::string ErrorOf(const Function& f) {
  try {
    f();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(BarrierCost, IsNothingForOneTask) {
  EXPECT_EQ(kAllAlgorithms.Seconds(1), 0);
}

TEST(BarrierCost, GrowsWithEachTaskThatCounts) {
  EXPECT_EQ(kAllAlgorithms.Seconds(2), 8);
  EXPECT_EQ(kAllAlgorithms.Seconds(3), 9);
  EXPECT_EQ(kAllAlgorithms.Seconds(6), 12);
}

TEST(BarrierCost, IsOfAsManyRoundsAsTheLogarithmSays) {
  EXPECT_EQ(kAllAlgorithms.Seconds(7), 300);
  EXPECT_EQ(kAllAlgorithms.Seconds(8), 300);
  EXPECT_EQ(kAllAlgorithms.Seconds(9), 400);
  EXPECT_EQ(kAllAlgorithms.Seconds(16), 400);
  EXPECT_EQ(kAllAlgorithms.Seconds(17), 500);
  EXPECT_EQ(kAllAlgorithms.Seconds(32), 500);
}

// 1 + 4 + 16 = 21 members fill two levels below the root, 85 three, 341 four.
TEST(BarrierCost, IsOfAsManyLevelsAsATreeOfFourChildrenHas) {
  EXPECT_EQ(kAllAlgorithms.Seconds(33), 3000);
  EXPECT_EQ(kAllAlgorithms.Seconds(85), 3000);
  EXPECT_EQ(kAllAlgorithms.Seconds(86), 4000);
  EXPECT_EQ(kAllAlgorithms.Seconds(341), 4000);
  EXPECT_EQ(kAllAlgorithms.Seconds(342), 5000);
}

TEST(BarrierCost, IsCountedForAllWhereThereIsNoOtherAlgorithm) {
  constexpr BarrierCost kCounted = {.two = 8, .further = 1};
  for (const int num_tasks : {2, 6, 7, 8, 9, 32, 33, 86}) {
    EXPECT_EQ(kCounted.Seconds(num_tasks), 8 + (num_tasks - 2)) << num_tasks;
  }
  EXPECT_EQ(kCounted.Seconds(1), 0);
}

TEST(BarrierCost, IsCountedWhereOnlyTheOtherAlgorithmIsKnown) {
  constexpr BarrierCost kRounds = {.two = 8, .further = 1, .round = 100};
  EXPECT_EQ(kRounds.Seconds(32), 500);
  EXPECT_EQ(kRounds.Seconds(33), 39);
  constexpr BarrierCost kLevels = {.two = 8, .further = 1, .level = 1000};
  EXPECT_EQ(kLevels.Seconds(32), 38);
  EXPECT_EQ(kLevels.Seconds(33), 3000);
}

TEST(SlowdownOn, IsThatOfTheLastThatBegins) {
  MachineModel machine;
  machine.slowdowns = {{2, 0, 1.1, "clock"}, {8, 0, 1.5, "memory"}};
  for (const int lanes : {1, 4}) {
    EXPECT_EQ(machine.SlowdownOn(1, lanes), 1);
    EXPECT_EQ(machine.SlowdownOn(2, lanes), 1.1);
    EXPECT_EQ(machine.SlowdownOn(7, lanes), 1.1);
    EXPECT_EQ(machine.SlowdownOn(8, lanes), 1.5);
    EXPECT_EQ(machine.SlowdownOn(64, lanes), 1.5);
  }
}

TEST(SlowdownOn, IsThatOfItsWidth) {
  MachineModel machine;
  machine.slowdowns = {
      {2, 1, 1.1, ""}, {4, 1, 1.2, ""}, {2, 4, 1.5, ""}, {8, 4, 2, ""}};
  EXPECT_EQ(machine.SlowdownOn(1, 4), 1);
  EXPECT_EQ(machine.SlowdownOn(2, 1), 1.1);
  EXPECT_EQ(machine.SlowdownOn(2, 4), 1.5);
  EXPECT_EQ(machine.SlowdownOn(4, 1), 1.2);
  EXPECT_EQ(machine.SlowdownOn(4, 4), 1.5);
  EXPECT_EQ(machine.SlowdownOn(8, 1), 1.2);
  EXPECT_EQ(machine.SlowdownOn(8, 4), 2);
}

// Of those of all widths and of its own, the last one of the list.
TEST(SlowdownOn, OfOneWidthTakesThePlaceOfThatOfAllBeforeIt) {
  MachineModel machine;
  machine.slowdowns = {{2, 0, 1.1, ""}, {8, 0, 1.5, ""}, {4, 4, 2, ""}};
  EXPECT_EQ(machine.SlowdownOn(2, 4), 1.1);
  EXPECT_EQ(machine.SlowdownOn(4, 4), 2);
  EXPECT_EQ(machine.SlowdownOn(8, 4), 2);
  EXPECT_EQ(machine.SlowdownOn(8, 1), 1.5);
}

TEST(SlowdownOn, IsOneWithoutSlowdowns) {
  EXPECT_EQ(MachineModel{}.SlowdownOn(64, 1), 1);
}

TEST(BlocksOf, AreThoseOfTheWidth) {
  MachineModel machine;
  machine.lanes[1][0].call = 1;
  machine.lanes[4][0].call = 4;
  EXPECT_EQ(machine.BlocksOf(1)[0].call, 1);
  EXPECT_EQ(machine.BlocksOf(4)[0].call, 4);
}

TEST(BlocksOf, NamesTheWidthsThatTheMachineHas) {
  MachineModel machine;
  machine.name = "m";
  machine.lanes[1] = {};
  EXPECT_EQ(ErrorOf([&] { (void)machine.BlocksOf(4); }),
            "machine 'm' has no costs for 4 lanes: expected one of 1");
  machine.lanes[4] = {};
  EXPECT_EQ(ErrorOf([&] { (void)machine.BlocksOf(2); }),
            "machine 'm' has no costs for 2 lanes: expected one of 1, 4");
}

TEST(WaitOf, IsThatOfTheConditionAndTheKind) {
  const MachineModel machine;
  Condition condition;
  condition.waits[WaitKind::kSpin].event = 1;
  condition.waits[WaitKind::kHold].event = 2;
  EXPECT_EQ(machine.WaitOf(condition, WaitKind::kSpin).event, 1);
  EXPECT_EQ(machine.WaitOf(condition, WaitKind::kHold).event, 2);
}

TEST(WaitOf, NamesTheWaysToWaitThatTheConditionHas) {
  MachineModel machine;
  machine.name = "m";
  Condition condition;
  condition.waits[WaitKind::kSpin] = {};
  condition.waits[WaitKind::kHold] = {};
  EXPECT_EQ(
      ErrorOf([&] { (void)machine.WaitOf(condition, WaitKind::kLogical); }),
      "machine 'm' has no costs for the way to wait 'logical': expected one of "
      "spin, hold");
}

}  // namespace
}  // namespace bench::predict
