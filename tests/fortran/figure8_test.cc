// Figure 8 in FORTRAN 77 (figure8.f) gives the same doubles as in C++, for
// every partition. Both are compiled here without fused multiply-add, which
// compilers choose as they like; the sums are in one order.

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <string>
#include <vector>

#include "integrators/integration.h"
#include "tests/support/model_system.h"

using Integer = MACROTASK_FORTRAN_INTEGER;

extern "C" void figur8_(const Integer* m, const Integer* p, const Integer* mhat,
                        const Integer* phat, const Integer* num_blocks,
                        const Integer* start, const double* h,
                        const double* predictor,  // (5, p), column by column
                        const double* corrector,  // (5, p)
                        const double* y0, const double* f0, double* y);

namespace {

using integrators::BlockMethod;
using integrators::Partition;
using integrators::Rational;
using support::ModelSystem;

constexpr int kNumValues = 5;
constexpr int kStart = kNumValues - 1;  // grid point of the first y_0
constexpr int kNumBlocks = 10;
constexpr double kStep = 0.03125;

std::vector<double> Flat(const std::vector<std::vector<Rational>>& weights) {
  std::vector<double> flat;
  for (const auto& row : weights) {
    for (const Rational& weight : row) flat.push_back(weight.value());
  }
  return flat;
}

std::vector<double> RunInFortran(const ModelSystem& model,
                                 const BlockMethod& method,
                                 Partition partition) {
  std::vector<double> f0;
  for (int n = 0; n <= kStart; ++n) {
    const std::vector<double> f = model.SolutionRate(n * kStep);
    f0.insert(f0.end(), f.begin(), f.end());
  }
  const std::vector<double> y0 = model.Solution(kStart * kStep);
  const std::vector<double> predictor = Flat(method.predictor);
  const std::vector<double> corrector = Flat(method.corrector);
  std::vector<double> y(y0.size());
  const Integer m = model.num_chains(), p = method.block_size,
                mhat = partition.chain_tasks,
                phat = partition.integration_tasks, num_blocks = kNumBlocks,
                start = kStart;
  figur8_(&m, &p, &mhat, &phat, &num_blocks, &start, &kStep, predictor.data(),
          corrector.data(), y0.data(), f0.data(), y.data());
  return y;
}

std::vector<double> RunInCpp(const ModelSystem& model,
                             const BlockMethod& method, Partition partition) {
  integrators::Integration integration(
      model, {.method = method,
              .step = kStep,
              .num_steps = kStart + kNumBlocks * method.block_size,
              .figure = integrators::Figure::kFigure8,
              .partition = partition});
  const auto result = integration.RunFrom([&](int n, double* y, double* f) {
    std::ranges::copy(model.Solution(n * kStep), y);
    std::ranges::copy(model.SolutionRate(n * kStep), f);
  });
  return result.state;
}

std::vector<std::uint64_t> Bits(const std::vector<double>& values) {
  std::vector<std::uint64_t> bits;
  for (const double value : values) {
    bits.push_back(std::bit_cast<std::uint64_t>(value));
  }
  return bits;
}

class FortranFigure8 : public testing::TestWithParam<const char*> {};

TEST_P(FortranFigure8, GivesTheStatesOfTheCppProgramBitForBit) {
  const BlockMethod method = integrators::ParseBlockMethod(GetParam());
  for (const int m : {1, 3, 4}) {
    const ModelSystem model(m);
    const auto expected = RunInCpp(model, method, {});
    for (int mhat = 1; mhat <= m; ++mhat) {
      for (int phat = 1; phat <= method.block_size; ++phat) {
        const Partition partition = {mhat, phat};
        EXPECT_EQ(Bits(RunInFortran(model, method, partition)), Bits(expected))
            << m << " chains, " << mhat << " x " << phat << " tasks";
        EXPECT_EQ(Bits(RunInCpp(model, method, partition)), Bits(expected));
      }
    }
  }
}

// What both compute is the problem's solution, and not the starting values.
TEST_P(FortranFigure8, ComesNearTheSolution) {
  const BlockMethod method = integrators::ParseBlockMethod(GetParam());
  const ModelSystem model(4);
  const double end = (kStart + kNumBlocks * method.block_size) * kStep;
  const std::vector<double> y = RunInFortran(model, method, {2, 1});
  const std::vector<double> solution = model.Solution(end);
  // About (p h)^5, times the constant of the method.
  for (std::size_t n = 0; n < y.size(); ++n)
    EXPECT_NEAR(y[n], solution[n], 1e-5);
}

INSTANTIATE_TEST_SUITE_P(Methods, FortranFigure8,
                         testing::Values("B1PC5", "B2PC5", "B4PC5"),
                         [](const auto& method) { return method.param; });

}  // namespace
