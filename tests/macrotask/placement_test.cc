#include "macrotask/placement.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

namespace macrotask {
namespace {

TEST(PlacementTest, PinsIfThereAreEnoughProcessors) {
  const Placement placement(NumProcessors());
  EXPECT_TRUE(placement.pinned());
  for (int task = 0; task < placement.num_tasks(); ++task) {
    EXPECT_TRUE(IsUsable(placement.processor(task)));
    if (task == 0) continue;
    EXPECT_LT(placement.processor(task - 1), placement.processor(task));
  }
}

TEST(PlacementTest, LeavesMoreTasksThanProcessorsToTheSystem) {
  const Placement placement(NumProcessors() + 1);
  EXPECT_FALSE(placement.pinned());
  EXPECT_EQ(placement.processor(0), kAnyProcessor);
  EXPECT_EQ(placement.processor(NumProcessors()), kAnyProcessor);
}

TEST(PlacementTest, TextNamesTheProcessorOfEveryTask) {
  const Placement one(1);
  EXPECT_EQ(one.ToString(), "1 task pinned: task 0 on processor " +
                                std::to_string(one.processor(0)));
  if (NumProcessors() < 2) GTEST_SKIP() << "needs 2 processors";
  const Placement two(2);
  EXPECT_EQ(two.ToString(), "2 tasks pinned: task 0 on processor " +
                                std::to_string(two.processor(0)) +
                                ", task 1 on processor " +
                                std::to_string(two.processor(1)));
}

TEST(PlacementTest, TextSaysWhenTasksAreNotPinned) {
  const int num_tasks = NumProcessors() + 14;
  const std::string noun = NumProcessors() == 1 ? "processor" : "processors";
  EXPECT_EQ(Placement(num_tasks).ToString(),
            std::to_string(num_tasks) + " tasks on " +
                std::to_string(NumProcessors()) + " " + noun + ", not pinned");
}

TEST(PlacementTest, RefusesLessThanOneTask) {
  EXPECT_THROW(Placement(0), std::invalid_argument);
}

TEST(IsUsableTest, IsFalseOutsideTheSystem) {
  EXPECT_FALSE(IsUsable(kAnyProcessor));
  EXPECT_FALSE(IsUsable(1 << 20));
}

}  // namespace
}  // namespace macrotask
