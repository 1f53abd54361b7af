#pragma once

#include <array>

#include "dynamics/model.h"
#include "dynamics/pack.h"
#include "dynamics/spatial.h"

namespace dynamics {

// Number of elements of the lower triangle of a 6 x 6 matrix, row by row.
inline constexpr int kTriangle6 = 21;

// What the reference member feels of one chain (or of all of them, summed):
// the terms of [MSO93 (10)] that OCD hands to RMA.
template <typename S>
struct TipInertia {
  std::array<S, kTriangle6> Lambda;  // lower triangle, row by row
  std::array<S, 6> Lambda_a_open;    // Lambda x''_open

  TipInertia& operator+=(const TipInertia& other) {
    for (int i = 0; i < kTriangle6; ++i) Lambda[i] += other.Lambda[i];
    for (int i = 0; i < 6; ++i) Lambda_a_open[i] += other.Lambda_a_open[i];
    return *this;
  }
};

// State of the reference member and its rate of change. The quaternion turns
// the member's axes into those of the world; it is integrated as it is, four
// numbers, and read as Q / |Q|, so that its norm may drift with the error of
// the integration but no order is lost to rescaling.
template <typename S>
struct MemberState {
  std::array<S, 4> Q;  // (w, x, y, z)
  Vector3<S> p;        // centre of mass P, world axes, m
  Vector3<S> omega;    // world axes, rad/s
  Vector3<S> v;        // of P, world axes, m/s
};

// Axes of the reference member, in world axes, from its quaternion.
template <typename S>
Matrix3<S> MemberAxes(const std::array<S, 4>& Q);

// Block RMA of Figure 1, reference member acceleration [MSO93 (10)]:
//
//   [I_r + sum_k Lambda_k] a_r = g_r - b_r + sum_k Lambda_k x_k,open''
//
// with I_r and b_r = [omega x I omega; 0], g_r = [0; m g] about P in world
// axes. `sum` holds both sums over k. `a_r` is the classical acceleration
// [omega'; v'] of P. Returns, lane by lane, a number that is positive iff the
// matrix is positive definite and a_r is finite. No allocation.
// Cost: bench row "RMA".
template <typename S>
S CalcMemberAcceleration(const ReferenceMember& member,
                         const Eigen::Vector3d& gravity,
                         const MemberState<S>& state, const TipInertia<S>& sum,
                         Vector6<S>* a_r);

// Force [moment; force] about P that the chains together must exert on the
// member for the acceleration a_r [MSO93 (9)]: sum_k f_k = I_r a_r + b_r - g_r.
Vector6<double> CalcMemberForce(const ReferenceMember& member,
                                const Eigen::Vector3d& gravity,
                                const MemberState<double>& state,
                                const Vector6<double>& a_r);

// Rate of change of the state: Q' = 1/2 (0, omega) Q, p' = v, [omega'; v'] =
// a_r.
template <typename S>
MemberState<S> MemberDerivative(const MemberState<S>& state,
                                const Vector6<S>& a_r);

}  // namespace dynamics
