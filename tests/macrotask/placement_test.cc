#include "macrotask/placement.h"

#include <gtest/gtest.h>
#include <pthread.h>
#include <sched.h>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

#include "macrotask/task.h"

namespace macrotask {
namespace {

TEST(PlacementTest, GivesEachTaskAProcessorIfThereAreEnough) {
  const Placement placement(NumProcessors());
  EXPECT_FALSE(placement.is_crowded());
  for (int task = 0; task < placement.num_tasks(); ++task) {
    EXPECT_TRUE(IsUsable(placement.processor(task)));
    if (task == 0) continue;
    EXPECT_LT(placement.processor(task - 1), placement.processor(task));
  }
}

TEST(PlacementTest, GivesProcessorsToNeighboursIfThereAreTooFew) {
  for (const int num_tasks : {NumProcessors() + 1, 7 * NumProcessors() + 3}) {
    const Placement placement(num_tasks);
    EXPECT_TRUE(placement.is_crowded());
    std::vector<int> num_here(static_cast<std::size_t>(NumProcessors()));
    for (int task = 0; task < num_tasks; ++task) {
      EXPECT_TRUE(IsUsable(placement.processor(task)));
      ++num_here.at(static_cast<std::size_t>(placement.index(task)));
      if (task == 0) continue;
      EXPECT_GE(placement.index(task), placement.index(task - 1));
    }
    const auto [fewest, most] =
        std::minmax_element(num_here.begin(), num_here.end());
    EXPECT_LE(*most - *fewest, 1);
  }
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

TEST(PlacementTest, TextNamesTheTasksThatShareAProcessor) {
  const Placement placement(16 * NumProcessors());
  const std::string begin = std::to_string(placement.num_tasks()) +
                            " tasks pinned: tasks 0 to 15 on processor " +
                            std::to_string(placement.processor(0));
  EXPECT_EQ(placement.ToString().substr(0, begin.size()), begin);
  if (NumProcessors() < 2) GTEST_SKIP() << "needs 2 processors";
  const std::string second = ", tasks 16 to 31 on processor " +
                             std::to_string(placement.processor(16));
  EXPECT_EQ(placement.ToString().substr(begin.size(), second.size()), second);
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
  EXPECT_FALSE(Placement(1).is_crowded());
  EXPECT_TRUE(Placement(2).is_crowded());
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
