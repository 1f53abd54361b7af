// The order that each method claims, measured.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "integrators/integration.h"
#include "tests/support/model_system.h"

namespace integrators {
namespace {

using support::ModelSystem;

constexpr double kDuration = 2;

double Error(const BlockMethod& method, int num_steps, bool exact_start) {
  const ModelSystem model(4);
  const double h = kDuration / num_steps;
  Integration integration(
      model, {.method = method, .step = h, .num_steps = num_steps});
  const auto known = [&](int n, double* y, double* f) {
    const auto state = model.Solution(n * h), rate = model.SolutionRate(n * h);
    std::copy(state.begin(), state.end(), y);
    std::copy(rate.begin(), rate.end(), f);
  };
  const IntegrationResult result = exact_start
                                       ? integration.RunFrom(known)
                                       : integration.Run(model.Solution(0));
  const std::vector<double> solution = model.Solution(kDuration);
  double worst = 0;
  for (std::size_t e = 0; e < solution.size(); ++e) {
    worst = std::max(worst, std::abs(result.state[e] - solution[e]));
  }
  return worst;
}

class MethodOrder : public testing::TestWithParam<const char*> {};

// Sign cancellations make a single halving unreliable: over three halvings the
// error falls by at least 2^(3 x 4.5), and it ends far above rounding.
TEST_P(MethodOrder, IsFiveOrMoreFromEitherStart) {
  const BlockMethod method = ParseBlockMethod(GetParam());
  for (const bool exact_start : {true, false}) {
    const double coarse = Error(method, 44, exact_start);
    const double fine = Error(method, 8 * 44, exact_start);
    EXPECT_GT(std::log2(coarse / fine) / 3, 4.5)
        << "error " << coarse << " -> " << fine;
    EXPECT_GT(fine, 1e-14);
  }
}

INSTANTIATE_TEST_SUITE_P(Methods, MethodOrder,
                         testing::Values("B1PC5", "B2PC5", "B4PC5"),
                         [](const auto& instance) {
                           return std::string(instance.param);
                         });

TEST(MethodOrder, FewerValuesGiveALowerOrder) {
  const BlockMethod method = MakeBlockMethod(1, 3);
  const double order =
      std::log2(Error(method, 44, true) / Error(method, 8 * 44, true)) / 3;
  EXPECT_GT(order, 2.5);
  EXPECT_LT(order, 4.0);
}

}  // namespace
}  // namespace integrators
