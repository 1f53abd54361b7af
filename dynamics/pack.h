#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace dynamics {
namespace internal {

// GCC ignores the attribute unless the element's type is a parameter too.
template <typename Element, int kLanes>
struct VectorOf {
  using Type [[gnu::vector_size(sizeof(Element) * kLanes)]] = Element;
};

}  // namespace internal

// A fixed number of doubles that are computed with at once, one lane each: the
// scalar type with which the numeric core works on `kLanes` (chain, point)
// pairs in the time of one. Every operation is lane-wise and none looks at
// another lane, so that what a lane holds never depends on its neighbours:
// this is what keeps results independent of the partition, bit for bit.
//
// Built on the vector types of GCC and Clang, which lower to whatever the
// target has (AVX2: one register for four lanes; SSE2: two). The open-chain
// dynamics take the same time with std::experimental::simd and with xsimd; this
// needs neither, and has a sine whose path does not depend on other lanes.
template <int kLanes>
struct Pack {
  static_assert(kLanes >= 2 && (kLanes & (kLanes - 1)) == 0,
                "a vector register holds a power of two of lanes");
  using Values = typename internal::VectorOf<double, kLanes>::Type;
  using Bits = typename internal::VectorOf<std::int64_t, kLanes>::Type;

  Pack() = default;
  // All lanes hold `x` (implicit, as the literals in formulas need it).
  Pack(double x) : values(x - Values{}) {}
  explicit Pack(Values v) : values(v) {}

  double operator[](int lane) const { return values[lane]; }
  void Set(int lane, double x) { values[lane] = x; }

  Pack& operator+=(Pack b) { return *this = *this + b; }
  Pack& operator-=(Pack b) { return *this = *this - b; }
  Pack& operator*=(Pack b) { return *this = *this * b; }
  Pack& operator/=(Pack b) { return *this = *this / b; }

  friend Pack operator+(Pack a, Pack b) { return Pack(a.values + b.values); }
  friend Pack operator-(Pack a, Pack b) { return Pack(a.values - b.values); }
  friend Pack operator*(Pack a, Pack b) { return Pack(a.values * b.values); }
  friend Pack operator/(Pack a, Pack b) { return Pack(a.values / b.values); }
  friend Pack operator-(Pack a) { return Pack(-a.values); }

  Values values;
};

// Number of (chain, point) pairs that one value of the scalar type stands for.
template <typename Scalar>
inline constexpr int kLanesOf = 1;
template <int kLanes>
inline constexpr int kLanesOf<Pack<kLanes>> = kLanes;

// One lane of a scalar: the same code reads a double and a pack.
inline double Lane(double x, int /*lane*/) { return x; }
inline void SetLane(double* x, int /*lane*/, double value) { *x = value; }
template <int kLanes>
double Lane(Pack<kLanes> x, int lane) {
  return x[lane];
}
template <int kLanes>
void SetLane(Pack<kLanes>* x, int lane, double value) {
  x->Set(lane, value);
}

// The smaller of two in every lane; a NaN in `a` stays.
inline double Min(double a, double b) { return b < a ? b : a; }
template <int kLanes>
Pack<kLanes> Min(Pack<kLanes> a, Pack<kLanes> b) {
  return Pack<kLanes>(b.values < a.values ? b.values : a.values);
}

}  // namespace dynamics

namespace Eigen {

template <int kLanes>
struct NumTraits<dynamics::Pack<kLanes>>
    : GenericNumTraits<dynamics::Pack<kLanes>> {
  using Real = dynamics::Pack<kLanes>;
  using NonInteger = dynamics::Pack<kLanes>;
  using Nested = dynamics::Pack<kLanes>;
  using Literal = double;
  enum {
    IsComplex = 0,
    IsInteger = 0,
    IsSigned = 1,
    RequireInitialization = 0,
    ReadCost = 1,
    AddCost = 1,
    MulCost = 1
  };
};

}  // namespace Eigen
