#include "integrators/rational.h"

#include <numeric>
#include <stdexcept>

namespace integrators {
namespace {

std::int64_t Times(std::int64_t a, std::int64_t b) {
  std::int64_t product;
  if (__builtin_mul_overflow(a, b, &product)) {
    throw std::overflow_error("a coefficient does not fit 64-bit fractions");
  }
  return product;
}

std::int64_t Plus(std::int64_t a, std::int64_t b) {
  std::int64_t sum;
  if (__builtin_add_overflow(a, b, &sum)) {
    throw std::overflow_error("a coefficient does not fit 64-bit fractions");
  }
  return sum;
}

}  // namespace

Rational::Rational(std::int64_t num, std::int64_t den) {
  if (den == 0) throw std::invalid_argument("a fraction's denominator is zero");
  const std::int64_t divisor = std::gcd(num, den) * (den < 0 ? -1 : 1);
  num_ = num / divisor;
  den_ = den / divisor;
}

std::string Rational::ToString() const {
  if (den_ == 1) return std::to_string(num_);
  return std::to_string(num_) + "/" + std::to_string(den_);
}

Rational operator+(const Rational& a, const Rational& b) {
  const std::int64_t common = std::gcd(a.den_, b.den_);
  const std::int64_t a_scale = b.den_ / common;
  const std::int64_t b_scale = a.den_ / common;
  return Rational(Plus(Times(a.num_, a_scale), Times(b.num_, b_scale)),
                  Times(a.den_, a_scale));
}

Rational operator-(const Rational& a, const Rational& b) {
  return a + Rational(Times(b.num_, -1), b.den_);
}

Rational operator*(const Rational& a, const Rational& b) {
  // Crosswise reduction first keeps the products small.
  const Rational left(a.num_, b.den_);
  const Rational right(b.num_, a.den_);
  return Rational(Times(left.num_, right.num_), Times(left.den_, right.den_));
}

Rational operator/(const Rational& a, const Rational& b) {
  return a * Rational(b.den_, b.num_);
}

}  // namespace integrators
