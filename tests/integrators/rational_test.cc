#include "integrators/rational.h"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

namespace integrators {
namespace {

TEST(Rational, IsKeptInLowestTermsWithPositiveDenominator) {
  const Rational half(-3, -6);
  EXPECT_EQ(half.num(), 1);
  EXPECT_EQ(half.den(), 2);
  const Rational negative(4, -6);
  EXPECT_EQ(negative.num(), -2);
  EXPECT_EQ(negative.den(), 3);
  EXPECT_EQ(Rational(0, -7), Rational(0));
}

TEST(Rational, ArithmeticIsExact) {
  const Rational a(1, 6), b(3, 10);
  EXPECT_EQ(a + b, Rational(7, 15));
  EXPECT_EQ(a - b, Rational(-2, 15));
  EXPECT_EQ(a * b, Rational(1, 20));
  EXPECT_EQ(a / b, Rational(5, 9));
}

TEST(Rational, PrintsAsAFraction) {
  EXPECT_EQ(Rational(1901, 720).ToString(), "1901/720");
  EXPECT_EQ(Rational(-6, 3).ToString(), "-2");
}

TEST(Rational, OverflowThrowsInsteadOfWrapping) {
  const Rational large(std::numeric_limits<std::int64_t>::max() / 2);
  EXPECT_THROW(large * large, std::overflow_error);
  EXPECT_THROW(large + large + large, std::overflow_error);
}

TEST(Rational, ZeroDenominatorThrows) {
  EXPECT_THROW(Rational(1, 0), std::invalid_argument);
  EXPECT_THROW(Rational(1) / Rational(0), std::invalid_argument);
}

}  // namespace
}  // namespace integrators
