#pragma once

#include <Eigen/Core>

// Spatial vectors and matrices: angular part first. Every spatial quantity of
// a chain is taken about one point, the centre of mass P of the reference
// member as that chain carries it, with the axes of the world. So nothing is
// ever shifted or rotated from link to link, and the columns of the Jacobian
// are the joint axes themselves.

namespace dynamics {

template <typename S>
using Vector3 = Eigen::Matrix<S, 3, 1>;
template <typename S>
using Matrix3 = Eigen::Matrix<S, 3, 3>;
template <typename S>
using Vector6 = Eigen::Matrix<S, 6, 1>;
template <typename S>
using Matrix6 = Eigen::Matrix<S, 6, 6>;

// a x b.
template <typename S>
inline Vector3<S> Cross(const Vector3<S>& a, const Vector3<S>& b) {
  return Vector3<S>(a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                    a[0] * b[1] - a[1] * b[0]);
}

// A velocity or acceleration [angular; linear], or a force [moment; force].
template <typename S>
struct SpatialVector {
  Vector3<S> angular;
  Vector3<S> linear;

  SpatialVector& operator+=(const SpatialVector& b) {
    angular += b.angular;
    linear += b.linear;
    return *this;
  }
  // The power of a force along a motion; likewise s . (I s).
  S Dot(const SpatialVector& b) const {
    return (angular[0] * b.angular[0] + angular[1] * b.angular[1] +
            angular[2] * b.angular[2]) +
           (linear[0] * b.linear[0] + linear[1] * b.linear[1] +
            linear[2] * b.linear[2]);
  }
};

// v x m: rate of change of a motion vector m that moves with velocity v.
template <typename S>
SpatialVector<S> CrossMotion(const SpatialVector<S>& v,
                             const SpatialVector<S>& m) {
  return {Cross(v.angular, m.angular),
          Cross(v.angular, m.linear) + Cross(v.linear, m.angular)};
}

// v x* f: the same for a force vector f.
template <typename S>
SpatialVector<S> CrossForce(const SpatialVector<S>& v,
                            const SpatialVector<S>& f) {
  return {Cross(v.angular, f.angular) + Cross(v.linear, f.linear),
          Cross(v.angular, f.linear)};
}

// Inertia of a rigid body about a point: ten numbers, so that composite
// bodies are sums.
template <typename S>
struct SpatialInertia {
  S mass;                    // kg
  Vector3<S> mass_moment;    // kg m, mass times (centre of mass - point)
  S xx, yy, zz, xy, xz, yz;  // kg m^2, rotational inertia about the point

  SpatialInertia& operator+=(const SpatialInertia& b) {
    mass += b.mass;
    mass_moment += b.mass_moment;
    xx += b.xx;
    yy += b.yy;
    zz += b.zz;
    xy += b.xy;
    xz += b.xz;
    yz += b.yz;
    return *this;
  }

  // I v: momentum of the body moving with v.
  SpatialVector<S> operator*(const SpatialVector<S>& v) const {
    const Vector3<S>& w = v.angular;
    const Vector3<S> I_w(xx * w[0] + xy * w[1] + xz * w[2],
                         xy * w[0] + yy * w[1] + yz * w[2],
                         xz * w[0] + yz * w[1] + zz * w[2]);
    return {I_w + Cross(mass_moment, v.linear),
            v.linear * mass - Cross(mass_moment, w)};
  }
};

}  // namespace dynamics
