#include "dynamics/reference_member.h"

#include "dynamics/ldlt.h"

namespace dynamics {
namespace {

// R I R^T.
template <typename S>
Matrix3<S> RotateInertia(const Matrix3<S>& R, const Eigen::Matrix3d& inertia) {
  const Matrix3<S> I = inertia.cast<S>();
  const Matrix3<S> RI = R * I;
  return RI * R.transpose();
}

}  // namespace

template <typename S>
Matrix3<S> MemberAxes(const std::array<S, 4>& Q) {
  const auto& [w, x, y, z] = Q;
  const S norm2 = w * w + x * x + y * y + z * z;
  const S two = S(2.0) / norm2;
  Matrix3<S> R;
  R(0, 0) = S(1.0) - two * (y * y + z * z);
  R(0, 1) = two * (x * y - w * z);
  R(0, 2) = two * (x * z + w * y);
  R(1, 0) = two * (x * y + w * z);
  R(1, 1) = S(1.0) - two * (x * x + z * z);
  R(1, 2) = two * (y * z - w * x);
  R(2, 0) = two * (x * z - w * y);
  R(2, 1) = two * (y * z + w * x);
  R(2, 2) = S(1.0) - two * (x * x + y * y);
  return R;
}

template <typename S>
[[gnu::flatten]] S CalcMemberAcceleration(const ReferenceMember& member,
                                          const Eigen::Vector3d& gravity,
                                          const MemberState<S>& state,
                                          const TipInertia<S>& sum,
                                          Vector6<S>* a_r) {
  const Matrix3<S> I = RotateInertia(MemberAxes(state.Q), member.inertia);
  const S m = S(member.mass);

  Matrix6<S> A;  // lower triangle of I_r + sum_k Lambda_k
  int element = 0;
  for (int a = 0; a < 6; ++a) {
    for (int b = 0; b <= a; ++b) A(a, b) = sum.Lambda[element++];
  }
  for (int a = 0; a < 3; ++a) {
    for (int b = 0; b <= a; ++b) A(a, b) += I(a, b);
    A(a + 3, a + 3) += m;
  }

  const Vector3<S> I_omega = I * state.omega;
  const Vector3<S> b_r = Cross(state.omega, I_omega);
  for (int i = 0; i < 3; ++i) {
    (*a_r)[i] = sum.Lambda_a_open[i] - b_r[i];
    (*a_r)[i + 3] = sum.Lambda_a_open[i + 3] + m * S(gravity[i]);
  }

  S d_inv[6];
  S margin = FactorizeLdlt(6, &A, d_inv);
  SolveLdlt(6, A, d_inv, a_r);
  // x - x is NaN for NaN and infinity alike, and 0 for all else.
  S finite = S(1.0);
  for (int i = 0; i < 6; ++i) finite += (*a_r)[i] - (*a_r)[i];
  return Min(finite, margin);
}

Vector6<double> CalcMemberForce(const ReferenceMember& member,
                                const Eigen::Vector3d& gravity,
                                const MemberState<double>& state,
                                const Vector6<double>& a_r) {
  const Matrix3<double> I = RotateInertia(MemberAxes(state.Q), member.inertia);
  const Vector3<double> I_omega = I * state.omega;
  Vector6<double> f;
  f << I * a_r.head<3>() + Cross(state.omega, I_omega),
      member.mass * (a_r.tail<3>() - gravity);
  return f;
}

template <typename S>
MemberState<S> MemberDerivative(const MemberState<S>& state,
                                const Vector6<S>& a_r) {
  const auto& [w, x, y, z] = state.Q;
  const Vector3<S>& o = state.omega;
  const S half = S(0.5);
  MemberState<S> rate;
  rate.Q = {-(half * (o[0] * x + o[1] * y + o[2] * z)),
            half * (o[0] * w + o[1] * z - o[2] * y),
            half * (o[1] * w + o[2] * x - o[0] * z),
            half * (o[2] * w + o[0] * y - o[1] * x)};
  rate.p = state.v;
  rate.omega = a_r.template head<3>();
  rate.v = a_r.template tail<3>();
  return rate;
}

#define DYNAMICS_INSTANTIATE(S)                                              \
  template Matrix3<S> MemberAxes(const std::array<S, 4>&);                   \
  template S CalcMemberAcceleration(                                         \
      const ReferenceMember&, const Eigen::Vector3d&, const MemberState<S>&, \
      const TipInertia<S>&, Vector6<S>*);                                    \
  template MemberState<S> MemberDerivative(const MemberState<S>&,            \
                                           const Vector6<S>&);
DYNAMICS_INSTANTIATE(double)
DYNAMICS_INSTANTIATE(Pack<4>)
#undef DYNAMICS_INSTANTIATE

}  // namespace dynamics
