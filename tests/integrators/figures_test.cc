// Every figure, partition, way to wait and number of processors gives the same
// doubles as the serial program.

#include <gtest/gtest.h>

#include <cstring>
#include <string>
#include <vector>

#include "integrators/integration.h"
#include "macrotask/placement.h"
#include "tests/support/model_system.h"

namespace integrators {
namespace {

using macrotask::WaitPolicy;
using support::ModelSystem;

struct Arrangement {
  Figure figure;
  Partition partition;
};

// All that a system of m chains and a block of b points allow.
std::vector<Arrangement> AllArrangements(int m, int b) {
  std::vector<Arrangement> all;
  for (int chains = 1; chains <= m; ++chains) {
    all.push_back({Figure::kFigure2, {chains, 1}});
    all.push_back({Figure::kFigure3, {chains, 1}});
    for (int points = 1; points <= b; ++points) {
      all.push_back({Figure::kFigure8, {chains, points}});
    }
  }
  for (int points = 1; points <= b; ++points) {
    all.push_back({Figure::kFigure7, {1, points}});
  }
  return all;
}

std::string ToString(const Arrangement& a) {
  return std::string(Name(a.figure)) + " " +
         std::to_string(a.partition.chain_tasks) + " x " +
         std::to_string(a.partition.integration_tasks);
}

IntegrationResult RunOnce(const ModelSystem& model, const BlockMethod& method,
                          const Arrangement& a, WaitPolicy wait,
                          int num_steps) {
  Integration integration(model, {.method = method,
                                  .step = 1.0 / num_steps,
                                  .num_steps = num_steps,
                                  .figure = a.figure,
                                  .partition = a.partition,
                                  .wait = wait});
  return integration.Run(model.Solution(0));
}

bool SameBits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() &&
         std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

struct Case {
  const char* method;
  WaitPolicy wait;
};

class Figures : public testing::TestWithParam<Case> {};

TEST_P(Figures, GiveTheStatesOfTheSerialProgramBitForBit) {
  const BlockMethod method = ParseBlockMethod(GetParam().method);
  constexpr int kSteps = 29;  // not a whole number of blocks
  for (const int m : {1, 3, 4}) {
    const ModelSystem model(m);
    const IntegrationResult serial =
        RunOnce(model, method, {Figure::kSerial, {}}, GetParam().wait, kSteps);
    for (const Arrangement& a : AllArrangements(m, method.block_size)) {
      const IntegrationResult result =
          RunOnce(model, method, a, GetParam().wait, kSteps);
      EXPECT_TRUE(SameBits(result.state, serial.state)) << ToString(a);
      EXPECT_EQ(result.evaluations, serial.evaluations);
    }
  }
}

// Many short runs on the same barriers' successors: a lost wake-up or a value
// read too early shows here if anywhere.
TEST_P(Figures, GiveTheSameStatesRunAfterRun) {
  const BlockMethod method = ParseBlockMethod(GetParam().method);
  const ModelSystem model(4);
  const Partition partition = {2, method.block_size >= 2 ? 2 : 1};
  Integration integration(model, {.method = method,
                                  .step = 0.05,
                                  .num_steps = 20,
                                  .figure = Figure::kFigure8,
                                  .partition = partition,
                                  .wait = GetParam().wait});
  const std::vector<double> first = integration.Run(model.Solution(0)).state;
  for (int run = 0; run < 30; ++run) {
    ASSERT_TRUE(SameBits(integration.Run(model.Solution(0)).state, first));
  }
}

TEST_P(Figures, StopTogetherWhenAChainFails) {
  const BlockMethod method = ParseBlockMethod(GetParam().method);
  for (const int chain : {0, 2}) {
    // Between the grid points 17 and 18 of 40.
    const ModelSystem model(
        3, {.kind = ModelSystem::Fault::kFails, .chain = chain, .time = 0.44});
    auto arrangements = AllArrangements(3, method.block_size);
    arrangements.push_back({Figure::kSerial, {}});
    for (const Arrangement& a : arrangements) {
      try {
        RunOnce(model, method, a, GetParam().wait, 40);
        ADD_FAILURE() << ToString(a);
      } catch (const IntegrationError& error) {
        EXPECT_EQ(error.what(),
                  "chain " + std::to_string(chain) + " fails at t = 0.450000 s")
            << ToString(a);
      }
    }
  }
}

TEST_P(Figures, PassOnWhatUserCodeThrows) {
  const BlockMethod method = ParseBlockMethod(GetParam().method);
  const ModelSystem model(
      3, {.kind = ModelSystem::Fault::kThrows, .chain = 1, .time = 0.44});
  for (const Arrangement& a : AllArrangements(3, method.block_size)) {
    try {
      RunOnce(model, method, a, GetParam().wait, 40);
      ADD_FAILURE() << ToString(a);
    } catch (const std::runtime_error& error) {
      EXPECT_STREQ(error.what(), "chain throws") << ToString(a);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(MethodsAndPolicies, Figures,
                         testing::Values(Case{"B1PC5", WaitPolicy::Block()},
                                         Case{"B1PC5", WaitPolicy::Spin()},
                                         Case{"B1PC5", WaitPolicy::Hold()},
                                         Case{"B1PC5", WaitPolicy::Logical()},
                                         Case{"B2PC5", WaitPolicy::Block()},
                                         Case{"B2PC5", WaitPolicy::Spin()},
                                         Case{"B2PC5", WaitPolicy::Hold()},
                                         Case{"B2PC5", WaitPolicy::Logical()},
                                         Case{"B4PC5", WaitPolicy::Block()},
                                         Case{"B4PC5", WaitPolicy::Spin()},
                                         Case{"B4PC5", WaitPolicy::Hold()},
                                         Case{"B4PC5", WaitPolicy::Logical()}),
                         [](const auto& instance) {
                           return std::string(instance.param.method) + "_" +
                                  std::string(Name(instance.param.wait.kind));
                         });

}  // namespace
}  // namespace integrators
