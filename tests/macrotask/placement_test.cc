#include "macrotask/placement.h"

#include <gtest/gtest.h>
#include <pthread.h>
#include <sched.h>

#include <stdexcept>
#include <string>

#include "macrotask/task.h"

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

int NumAllowed() {
  cpu_set_t mask;
  pthread_getaffinity_np(pthread_self(), sizeof mask, &mask);
  return CPU_COUNT(&mask);
}

// Gives all processors back at the end.
class SetMaxProcessorsTest : public testing::Test {
 protected:
  ~SetMaxProcessorsTest() override { SetMaxProcessors(num_processors_); }
  const int num_processors_ = NumProcessors();
};

TEST_F(SetMaxProcessorsTest, LeavesTheFirstOnes) {
  const int last = Placement(num_processors_).processor(num_processors_ - 1);
  const int first = Placement(1).processor(0);
  SetMaxProcessors(1);
  EXPECT_EQ(NumProcessors(), 1);
  EXPECT_TRUE(IsUsable(first));
  EXPECT_EQ(IsUsable(last), num_processors_ == 1);
  EXPECT_TRUE(Placement(1).pinned());
  EXPECT_FALSE(Placement(2).pinned());
  EXPECT_EQ(NumAllowed(), 1);
  EXPECT_EQ(sched_getcpu(), first);
}

TEST_F(SetMaxProcessorsTest, GivesNoMoreThanThereAre) {
  SetMaxProcessors(1 << 20);
  EXPECT_EQ(NumProcessors(), num_processors_);
  SetMaxProcessors(1);
  SetMaxProcessors(num_processors_);
  EXPECT_EQ(NumProcessors(), num_processors_);
  EXPECT_EQ(NumAllowed(), num_processors_);
}

// Also on pthreads that have run tasks before.
TEST_F(SetMaxProcessorsTest, BindsTheTasksThatStartAfterwards) {
  for (const int most : {num_processors_, 1, num_processors_}) {
    SetMaxProcessors(most);
    for (int round = 0; round < 3; ++round) {
      int num_allowed = 0;
      Task task([&] { num_allowed = NumAllowed(); });
      task.Wait();
      EXPECT_EQ(num_allowed, most);
    }
  }
}

TEST_F(SetMaxProcessorsTest, RefusesLessThanOne) {
  EXPECT_THROW(SetMaxProcessors(0), std::invalid_argument);
  EXPECT_THROW(SetMaxProcessors(-1), std::invalid_argument);
  EXPECT_EQ(NumProcessors(), num_processors_);
}

}  // namespace
}  // namespace macrotask
