#pragma once

#include <Eigen/Core>
#include <cmath>

namespace support {

// The oracles compute with 64 bits of mantissa.
using Real = long double;

// Forward-mode automatic differentiation: value + rate e with e^2 = 0.
// Dual<Dual<Real>> carries two directions and their mixed second derivative.
template <typename T>
struct Dual {
  Dual() = default;
  Dual(Real x) : value(x), rate(0) {}
  Dual(T v, T r) : value(v), rate(r) {}

  Dual& operator+=(const Dual& b) { return *this = *this + b; }
  Dual& operator-=(const Dual& b) { return *this = *this - b; }
  Dual& operator*=(const Dual& b) { return *this = *this * b; }

  friend Dual operator+(const Dual& a, const Dual& b) {
    return {a.value + b.value, a.rate + b.rate};
  }
  friend Dual operator-(const Dual& a, const Dual& b) {
    return {a.value - b.value, a.rate - b.rate};
  }
  friend Dual operator*(const Dual& a, const Dual& b) {
    return {a.value * b.value, a.value * b.rate + a.rate * b.value};
  }
  friend Dual operator-(const Dual& a) { return {-a.value, -a.rate}; }
  friend Dual sin(const Dual& a) {
    using std::cos, std::sin;
    return {sin(a.value), cos(a.value) * a.rate};
  }
  friend Dual cos(const Dual& a) {
    using std::cos, std::sin;
    return {cos(a.value), -sin(a.value) * a.rate};
  }

  T value;
  T rate;
};

}  // namespace support

namespace Eigen {

template <typename T>
struct NumTraits<support::Dual<T>> : GenericNumTraits<support::Dual<T>> {
  using Real = support::Dual<T>;
  using NonInteger = support::Dual<T>;
  using Nested = support::Dual<T>;
  using Literal = support::Real;
  enum {
    IsComplex = 0,
    IsInteger = 0,
    IsSigned = 1,
    RequireInitialization = 0,
    ReadCost = 1,
    AddCost = 2,
    MulCost = 4
  };
};

}  // namespace Eigen
