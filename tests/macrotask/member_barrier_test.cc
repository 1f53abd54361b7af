// Barrier::Sync(member), by every algorithm.

#include <gtest/gtest.h>

#include <cstddef>
#include <memory>
#include <stdexcept>
#include <string>
#include <tuple>
#include <vector>

#include "macrotask/barrier.h"
#include "macrotask/barrier_algorithm.h"
#include "macrotask/task.h"
#include "tests/macrotask/support.h"

namespace macrotask {
namespace {

std::size_t Index(int i) { return static_cast<std::size_t>(i); }

class MemberBarrierTest : public testing::TestWithParam<
                              std::tuple<BarrierAlgorithm, WaitPolicy, int>> {
 protected:
  BarrierAlgorithm algorithm() const { return std::get<0>(GetParam()); }
  WaitPolicy policy() const { return std::get<1>(GetParam()); }
  int num_tasks() const { return std::get<2>(GetParam()); }
  // As many as are quick even if 16 tasks share one processor.
  int num_rounds() const { return num_tasks() <= 2 ? 1000 : 800 / num_tasks(); }

  Barrier barrier_{num_tasks(), policy(), algorithm()};
};

TEST_P(MemberBarrierTest, NoMemberIsEverAPhaseAheadOrBehind) {
  EXPECT_EQ(CountPhaseErrors(
                num_tasks(), num_rounds(),
                [&](int task) { barrier_.Sync(task); }, policy()),
            0);
}

TEST_P(MemberBarrierTest, CarriesWhatWasWrittenBothWays) {
  EXPECT_EQ(MixSlots(
                num_tasks(), num_rounds(),
                [&](int task) { barrier_.Sync(task); }, policy()),
            MixedSlots(num_tasks(), num_rounds()));
}

// Any sequence of phases with and without members; and another task is the
// member in each.
TEST_P(MemberBarrierTest, MixesWithOtherPhasesAndOtherMembers) {
  std::vector<CacheAligned<unsigned>> phases(Index(num_tasks()));
  const auto sync = [&](int task) {
    const unsigned phase = ++*phases[Index(task)];
    // Runs of 1 to 3 of each kind.
    if (0b1101'0001'0110 >> phase % 12 & 1) return barrier_.Sync();
    const auto n = static_cast<unsigned>(num_tasks());
    barrier_.Sync(
        static_cast<int>((static_cast<unsigned>(task) + phase / 3) % n));
  };
  EXPECT_EQ(CountPhaseErrors(num_tasks(), num_rounds(), sync, policy()), 0);
  EXPECT_EQ(MixSlots(num_tasks(), num_rounds(), sync, policy()),
            MixedSlots(num_tasks(), num_rounds()));
}

TEST_P(MemberBarrierTest, SurvivesTheTasksThatLeaveItLast) {
  for (int round = 0; round < 20; ++round) {
    auto barrier =
        std::make_unique<Barrier>(num_tasks(), policy(), algorithm());
    RunTasks(
        num_tasks(), [&](int task) { barrier->Sync(task); }, policy());
    barrier.reset();
  }
}

TEST_P(MemberBarrierTest, CountsThoseWhoWait) {
  // A logical task that asks again and again lets nobody else run.
  if (policy().kind == WaitKind::kLogical) return;
  for (int late = 0; late < num_tasks(); ++late) {
    EXPECT_EQ(barrier_.num_waiting(), 0);
    RunTasks(
        num_tasks(),
        [&](int task) {
          if (task == late) {
            YieldUntil(
                [&] { return barrier_.num_waiting() == num_tasks() - 1; });
          }
          barrier_.Sync(task);
        },
        policy());
  }
  EXPECT_EQ(barrier_.num_waiting(), 0);
}

TEST_P(MemberBarrierTest, RefusesAMemberThatItHasNot) {
  for (int member : {-1, num_tasks()}) {
    try {
      barrier_.Sync(member);
      FAIL() << "a member " << member;
    } catch (const std::out_of_range& error) {
      EXPECT_EQ(error.what(), "barrier " + std::to_string(barrier_.number()) +
                                  " has members 0 to " +
                                  std::to_string(num_tasks() - 1) + ", not " +
                                  std::to_string(member));
    }
  }
  EXPECT_EQ(barrier_.num_waiting(), 0);
}

std::string ParameterName(
    const testing::TestParamInfo<MemberBarrierTest::ParamType>& info) {
  const auto& [algorithm, policy, num_tasks] = info.param;
  return std::string(Name(algorithm)) + "_" + std::string(Name(policy.kind)) +
         std::to_string(num_tasks);
}

INSTANTIATE_TEST_SUITE_P(
    Algorithms, MemberBarrierTest,
    testing::Combine(testing::ValuesIn(kAllBarrierAlgorithms),
                     testing::ValuesIn(kAllPolicies),
                     testing::ValuesIn(kTaskCounts)),
    ParameterName);

TEST(BarrierAlgorithmTest, NamesAreReadBack) {
  for (BarrierAlgorithm algorithm : kAllBarrierAlgorithms) {
    EXPECT_EQ(ParseBarrierAlgorithm(Name(algorithm)), algorithm);
  }
  EXPECT_EQ(ParseBarrierAlgorithm("unknown"), std::nullopt);
}

TEST(BarrierAlgorithmTest, OneIsChosenForEveryNumberOfTasks) {
  EXPECT_EQ(ChooseBarrierAlgorithm(1), BarrierAlgorithm::kCounter);
  EXPECT_EQ(ChooseBarrierAlgorithm(2), BarrierAlgorithm::kCounter);
  EXPECT_EQ(ChooseBarrierAlgorithm(6), BarrierAlgorithm::kCounter);
  EXPECT_EQ(ChooseBarrierAlgorithm(7), BarrierAlgorithm::kDissemination);
  EXPECT_EQ(ChooseBarrierAlgorithm(32), BarrierAlgorithm::kDissemination);
  EXPECT_EQ(ChooseBarrierAlgorithm(33), BarrierAlgorithm::kTree);
}

}  // namespace
}  // namespace macrotask
