#pragma once

// The body of CalcChainTerms, for the sources that inline it: chain_terms.cc
// and open_chain.cc.

#include "dynamics/chain_terms.h"
#include "dynamics/sincos.h"

namespace dynamics {
namespace internal {

// Turns the axes R about their own z axis by the angle q.
template <typename S>
void TurnAboutZ(const S& q, Matrix3<S>* R) {
  S s, c;
  SinCos(q, &s, &c);
  const Vector3<S> x = R->col(0) * c + R->col(1) * s;
  const Vector3<S> y = R->col(1) * c - R->col(0) * s;
  R->col(0) = x;
  R->col(1) = y;
}

// Poses of all joints, and P.
template <typename S>
void CalcPoses(const ChainConstants<S>& chain, const S* q,
               ChainTerms<S>* terms) {
  const int n = chain.num_joints();
  Matrix3<S> R = chain.joints[0].R_parent;
  Vector3<S> p = chain.joints[0].p_parent;
  for (int i = 0; i < n; ++i) {
    const auto& joint = chain.joints[i];
    if (i > 0) {
      p += R * joint.p_parent;
      R = (R * joint.R_parent).eval();
    }
    if (joint.type == JointType::kRevolute) {
      TurnAboutZ(q[i], &R);
    } else {
      p += R.col(2) * q[i];
    }
    terms->R[i] = R;
    terms->p[i] = p;
  }
  terms->P = p + R * chain.p_member;
}

// Inertia about P, in world axes, of a link whose joint frame has the axes R
// and its origin at d from P.
template <typename S>
SpatialInertia<S> LinkInertia(const typename ChainConstants<S>::Joint& joint,
                              const Matrix3<S>& R, const Vector3<S>& d) {
  const Vector3<S> c = d + R * joint.com;
  const Vector3<S> mc = c * joint.mass;
  const Matrix3<S> RI = R * joint.inertia;
  const auto rotated = [&](int a, int b) {
    return RI(a, 0) * R(b, 0) + RI(a, 1) * R(b, 1) + RI(a, 2) * R(b, 2);
  };
  SpatialInertia<S> I;
  I.mass = joint.mass;
  I.mass_moment = mc;
  I.xx = rotated(0, 0) + (mc[1] * c[1] + mc[2] * c[2]);
  I.yy = rotated(1, 1) + (mc[0] * c[0] + mc[2] * c[2]);
  I.zz = rotated(2, 2) + (mc[0] * c[0] + mc[1] * c[1]);
  I.xy = rotated(0, 1) - mc[0] * c[1];
  I.xz = rotated(0, 2) - mc[0] * c[2];
  I.yz = rotated(1, 2) - mc[1] * c[2];
  return I;
}

// Outward: Jacobian, velocities and accelerations with q'' = 0, and the force
// that each link needs for them. Gravity enters as an acceleration of the base
// upward, and is taken out again of J' q'.
template <typename S>
void CalcLinkForces(const ChainConstants<S>& chain, const S* qd,
                    ChainTerms<S>* terms) {
  const int n = chain.num_joints();
  SpatialVector<S> V = {Vector3<S>::Zero(), Vector3<S>::Zero()};
  SpatialVector<S> A = {Vector3<S>::Zero(), -chain.gravity};
  for (int i = 0; i < n; ++i) {
    const auto& joint = chain.joints[i];
    const Vector3<S> d = terms->p[i] - terms->P;
    const Vector3<S> z = terms->R[i].col(2);
    SpatialVector<S>& s = terms->J[i];
    if (joint.type == JointType::kRevolute) {
      s = {z, Cross(d, z)};
    } else {
      s = {Vector3<S>::Zero(), z};
    }
    const SpatialVector<S> s_qd = {s.angular * qd[i], s.linear * qd[i]};
    A += CrossMotion(V, s_qd);
    V += s_qd;
    const SpatialInertia<S> I = LinkInertia(joint, terms->R[i], d);
    SpatialVector<S> F = I * A;
    F += CrossForce(V, I * V);
    terms->I[i] = I;
    terms->F[i] = F;
  }
  terms->velocity = V;
  // From the acceleration of the body at P to that of the material point.
  terms->Jd_qd = {A.angular,
                  A.linear + chain.gravity + Cross(V.angular, V.linear)};
}

// Inward: composite bodies carry everything beyond joint i; H(i, j) = s_j . I_i
// s_i, bias_i = s_i . F_i.
template <typename S>
void CalcInertiaAndBias(const ChainConstants<S>& chain, ChainTerms<S>* terms) {
  const int n = chain.num_joints();
  for (int i = n - 1; i >= 0; --i) {
    if (i < n - 1) {
      terms->F[i] += terms->F[i + 1];
      terms->I[i] += terms->I[i + 1];
    }
    terms->bias[i] = terms->J[i].Dot(terms->F[i]);
    const SpatialVector<S> I_s = terms->I[i] * terms->J[i];
    for (int j = 0; j < i; ++j) terms->H(i, j) = terms->J[j].Dot(I_s);
    terms->H(i, i) = terms->J[i].Dot(I_s) + chain.joints[i].rotor_inertia;
  }
}

template <typename S>
void CalcChainTermsInline(const ChainConstants<S>& chain, const S* q,
                          const S* qd, ChainTerms<S>* terms) {
  CalcPoses(chain, q, terms);
  CalcLinkForces(chain, qd, terms);
  CalcInertiaAndBias(chain, terms);
}

}  // namespace internal
}  // namespace dynamics
