#pragma once

#include <cstdint>
#include <string>

namespace integrators {

// An exact fraction of 64-bit integers, in lowest terms, the denominator
// positive. Arithmetic that would overflow throws std::overflow_error.
class Rational {
 public:
  constexpr Rational(std::int64_t value = 0) : num_(value) {}
  Rational(std::int64_t num, std::int64_t den);  // den != 0

  std::int64_t num() const { return num_; }
  std::int64_t den() const { return den_; }
  double value() const {
    return static_cast<double>(num_) / static_cast<double>(den_);
  }
  std::string ToString() const;  // "1901/720", "3"

  friend Rational operator+(const Rational& a, const Rational& b);
  friend Rational operator-(const Rational& a, const Rational& b);
  friend Rational operator*(const Rational& a, const Rational& b);
  friend Rational operator/(const Rational& a, const Rational& b);  // b != 0
  friend bool operator==(const Rational& a, const Rational& b) = default;

 private:
  std::int64_t num_ = 0;
  std::int64_t den_ = 1;
};

}  // namespace integrators
