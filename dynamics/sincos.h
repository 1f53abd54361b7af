#pragma once

#include <bit>
#include <cstdint>

#include "dynamics/pack.h"

namespace dynamics {
namespace internal {

// An integer for each lane.
template <typename Scalar>
struct LaneBits {
  using Type = std::int64_t;
};
template <int kLanes>
struct LaneBits<Pack<kLanes>> {
  using Type = typename Pack<kLanes>::Bits;
};

inline std::int64_t ToBits(double x) { return std::bit_cast<std::int64_t>(x); }
template <int kLanes>
auto ToBits(Pack<kLanes> x) {
  return std::bit_cast<typename Pack<kLanes>::Bits>(x.values);
}
inline double FromBits(std::int64_t bits, double) {
  return std::bit_cast<double>(bits);
}
template <int kLanes>
Pack<kLanes> FromBits(typename Pack<kLanes>::Bits bits, Pack<kLanes>) {
  return Pack<kLanes>(std::bit_cast<typename Pack<kLanes>::Values>(bits));
}

}  // namespace internal

// Sine and cosine of `x` (rad) in every lane, without branches, so that a lane
// never depends on its neighbours (the vectorized libraries choose a path by
// looking at all lanes, which would tie results to the partition).
//
// Reduction to |r| <= pi/4 by multiples of pi/2 split in three parts of 33
// bits (Cody & Waite 1980), then the minimax polynomials of fdlibm's k_sin.c
// and k_cos.c. Absolute error below 2^-52 for |x| < 1e5 rad, growing with |x|
// beyond; NaN and infinities give NaN.
template <typename Scalar>
void SinCos(const Scalar& x, Scalar* sine, Scalar* cosine) {
  constexpr double kTwoOverPi = 0x1.45f306dc9c883p-1;
  constexpr double kHalfPi1 = 0x1.921fb544p+0;
  constexpr double kHalfPi2 = 0x1.0b4611a6p-34;
  constexpr double kHalfPi3 = 0x1.3198a2e037073p-69;
  // Adding 1.5 x 2^52 leaves no bits for a fraction: rounds to an integer,
  // whose last bits are the last bits of the sum.
  constexpr double kShift = 0x1.8p52;

  const Scalar shifted = x * Scalar(kTwoOverPi) + Scalar(kShift);
  const Scalar n = shifted - Scalar(kShift);
  const Scalar r = ((x - n * Scalar(kHalfPi1)) - n * Scalar(kHalfPi2)) -
                   n * Scalar(kHalfPi3);
  const Scalar z = r * r;

  Scalar s = Scalar(0x1.5d93a5acfd57cp-33);
  s = s * z - Scalar(0x1.ae5e68a2b9cebp-26);
  s = s * z + Scalar(0x1.71de357b1fe7dp-19);
  s = s * z - Scalar(0x1.a01a019c161d5p-13);
  s = s * z + Scalar(0x1.111111110f8a6p-7);
  s = s * z - Scalar(0x1.5555555555549p-3);
  s = r + (r * z) * s;

  Scalar c = Scalar(-0x1.8fae9be8838d4p-37);
  c = c * z + Scalar(0x1.1ee9ebdb4b1c4p-29);
  c = c * z - Scalar(0x1.27e4f809c52adp-22);
  c = c * z + Scalar(0x1.a01a019cb159p-16);
  c = c * z - Scalar(0x1.6c16c16c15177p-10);
  c = c * z + Scalar(0x1.555555555554cp-5);
  const Scalar half_z = Scalar(0.5) * z;
  const Scalar w = Scalar(1.0) - half_z;
  c = w + (((Scalar(1.0) - w) - half_z) + (z * z) * c);

  // Quadrant 1 and 3 exchange the two; the sine is negative in 2 and 3, the
  // cosine in 1 and 2.
  using Bits = typename internal::LaneBits<Scalar>::Type;
  const Bits quadrant = internal::ToBits(shifted);
  const Bits exchange = -(quadrant & 1);  // all ones where they change places
  const Bits s_bits = internal::ToBits(s);
  const Bits c_bits = internal::ToBits(c);
  const Bits differ = (s_bits ^ c_bits) & exchange;
  *sine = internal::FromBits((s_bits ^ differ) ^ ((quadrant & 2) << 62), x);
  *cosine =
      internal::FromBits((c_bits ^ differ) ^ (((quadrant + 1) & 2) << 62), x);
}

}  // namespace dynamics
