#include "integrators/block_method.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <vector>

namespace integrators {
namespace {

Rational Power(int base, int exponent) {
  Rational power = 1;
  for (int e = 0; e < exponent; ++e) power = power * base;
  return power;
}

std::vector<BlockMethod> Methods() {
  return {B1PC5(),
          B2PC5(),
          B4PC5(),
          MakeBlockMethod(4, 6),
          MakeBlockMethod(2, 8),
          MakeBlockMethod(8, 9)};
}

// sum_j w_j x_j^d, for derivative values at `first`, first + 1, ...
Rational Moment(const std::vector<Rational>& weights, int first, int d) {
  Rational sum = 0;
  for (std::size_t j = 0; j < weights.size(); ++j) {
    sum = sum + weights[j] * Power(first + static_cast<int>(j), d);
  }
  return sum;
}

TEST(BlockMethod, EveryFormulaIntegratesPolynomialsUpToItsDegreeExactly) {
  for (const BlockMethod& method : Methods()) {
    SCOPED_TRACE(method.name());
    for (int i = 1; i <= method.block_size; ++i) {
      const auto row = static_cast<std::size_t>(i - 1);
      for (int d = 0; d < method.num_values; ++d) {
        const Rational integral = Power(i, d + 1) / Rational(d + 1);
        EXPECT_EQ(Moment(method.predictor[row], 1 - method.num_values, d),
                  integral);
        EXPECT_EQ(
            Moment(method.corrector[row], method.first_corrector_offset(), d),
            integral);
      }
    }
  }
}

TEST(BlockMethod, NoFormulaOfTheFirstPointIntegratesOneDegreeMore) {
  for (const BlockMethod& method : Methods()) {
    const int d = method.num_values;
    EXPECT_NE(Moment(method.predictor[0], 1 - d, d), Rational(1, d + 1))
        << method.name();
  }
}

// The classical coefficients of Adams.
TEST(BlockMethod, B1PC5IsAdamsBashforthWithAdamsMoulton) {
  const BlockMethod method = B1PC5();
  const std::vector<Rational> bashforth = {
      {251, 720}, {-1274, 720}, {2616, 720}, {-2774, 720}, {1901, 720}};
  const std::vector<Rational> moulton = {
      {-19, 720}, {106, 720}, {-264, 720}, {646, 720}, {251, 720}};
  EXPECT_EQ(method.predictor[0], bashforth);
  EXPECT_EQ(method.corrector[0], moulton);
}

TEST(BlockMethod, LastCorrectorOfB4PC5IsBoolesRule) {
  const std::vector<Rational> boole = {
      {14, 45}, {64, 45}, {24, 45}, {64, 45}, {14, 45}};
  EXPECT_EQ(B4PC5().corrector[3], boole);
}

TEST(BlockMethod, CorrectorReadsTheNewestValues) {
  EXPECT_EQ(B1PC5().first_corrector_offset(), -3);
  EXPECT_EQ(B2PC5().first_corrector_offset(), -2);
  EXPECT_EQ(B4PC5().first_corrector_offset(), 0);
}

TEST(BlockMethod, NameIsReadBack) {
  for (const BlockMethod& method : Methods()) {
    const BlockMethod read = ParseBlockMethod(method.name());
    EXPECT_EQ(read.block_size, method.block_size);
    EXPECT_EQ(read.num_values, method.num_values);
  }
}

TEST(BlockMethod, UnknownNameIsQuotedWithWhatWasExpected) {
  for (const char* name : {"", "B", "RK4", "B4", "B4PC", "B0PC5", "B5PC5",
                           "B4PC5x", "b4pc5", "B-1PC5", "B9999999999PC5"}) {
    try {
      ParseBlockMethod(name);
      ADD_FAILURE() << name;
    } catch (const std::invalid_argument& error) {
      const std::string text = error.what();
      EXPECT_NE(text.find("'" + std::string(name) + "'"), std::string::npos);
      EXPECT_NE(text.find("B4PC5"), std::string::npos) << text;
    }
  }
}

TEST(BlockMethod, CoefficientsTooLargeForTheFractionsAreAnError) {
  EXPECT_THROW(MakeBlockMethod(20, 30), std::overflow_error);
}

}  // namespace
}  // namespace integrators
