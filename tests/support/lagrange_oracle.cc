#include "tests/support/lagrange_oracle.h"

#include <cmath>
#include <vector>

namespace support {
namespace {

template <typename T>
using Vector3 = Eigen::Matrix<T, 3, 1>;
template <typename T>
using Matrix3 = Eigen::Matrix<T, 3, 3>;
template <typename T>
using Matrix3X = Eigen::Matrix<T, 3, Eigen::Dynamic>;
template <typename T>
using VectorX = Eigen::Matrix<T, Eigen::Dynamic, 1>;
template <typename T>
using MatrixX = Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic>;

using Dual1 = Dual<Real>;
using Dual2 = Dual<Dual<Real>>;

// A constant of the model, as a value that does not move.
template <typename T, typename Derived>
auto Lift(const Eigen::MatrixBase<Derived>& m) {
  return m.template cast<Real>().template cast<T>().eval();
}

template <typename T>
struct Pose {
  // This pose followed by one that is constant.
  Pose operator*(const Eigen::Isometry3d& next) const {
    return {R * Lift<T>(next.linear()), p + R * Lift<T>(next.translation())};
  }
  Vector3<T> operator*(const Eigen::Vector3d& point) const {
    return p + R * Lift<T>(point);
  }
  Matrix3<T> R;
  Vector3<T> p;
};

template <typename T>
Pose<T> Moved(const Pose<T>& pose, dynamics::JointType type, const T& q) {
  using std::cos, std::sin;
  if (type == dynamics::JointType::kPrismatic) {
    return {pose.R, pose.p + pose.R * Vector3<T>(T(0), T(0), q)};
  }
  Matrix3<T> turn;
  turn << cos(q), -sin(q), T(0), sin(q), cos(q), T(0), T(0), T(0), T(1);
  return {pose.R * turn, pose.p};
}

// Poses of the N links, then of the reference member.
template <typename T>
std::vector<Pose<T>> CalcPoses(const dynamics::Chain& chain,
                               const VectorX<T>& q) {
  std::vector<Pose<T>> poses;
  Pose<T> pose = {Lift<T>(chain.base.linear()),
                  Lift<T>(chain.base.translation())};
  for (int i = 0; i < chain.arm.num_joints(); ++i) {
    const dynamics::Link& link = chain.arm.links[i];
    pose = Moved(pose * link.parent_to_joint, link.type, q[i]);
    poses.push_back(pose);
  }
  poses.push_back(pose * chain.arm.tip * chain.grip);
  return poses;
}

template <typename Derived>
auto Values(const Eigen::MatrixBase<Derived>& m) {
  return m.unaryExpr([](const auto& x) { return x.value; }).eval();
}
template <typename Derived>
auto Rates(const Eigen::MatrixBase<Derived>& m) {
  return m.unaryExpr([](const auto& x) { return x.rate; }).eval();
}

// omega of the axes R, from R' = [omega x] R.
template <typename T>
Vector3<T> AngularVelocity(const Matrix3<Dual<T>>& R) {
  const Matrix3<T> W = Rates(R) * Values(R).transpose();
  return Vector3<T>(W(2, 1) - W(1, 2), W(0, 2) - W(2, 0), W(1, 0) - W(0, 1)) *
         T(0.5L);
}

// Derivatives of a point fixed in a body, and of the body's axes, by q.
template <typename T>
struct Jacobians {
  explicit Jacobians(int n) : point(3, n), axes(3, n) {}
  Matrix3X<T> point;
  Matrix3X<T> axes;
};

// Those of the links at their centres of mass, then of the member at P.
template <typename T>
std::vector<Jacobians<T>> CalcJacobians(const dynamics::Chain& chain,
                                        const VectorX<T>& q) {
  const int n = chain.arm.num_joints();
  std::vector<Jacobians<T>> jacobians(n + 1, Jacobians<T>(n));
  for (int j = 0; j < n; ++j) {
    VectorX<Dual<T>> moving(n);
    for (int i = 0; i < n; ++i) moving[i] = {q[i], T(i == j ? 1 : 0)};
    const auto poses = CalcPoses(chain, moving);
    for (int i = 0; i <= n; ++i) {
      const Eigen::Vector3d com =
          i < n ? chain.arm.links[i].com : Eigen::Vector3d::Zero();
      jacobians[i].point.col(j) = Rates(poses[i] * com);
      jacobians[i].axes.col(j) = AngularVelocity(poses[i].R);
    }
  }
  return jacobians;
}

template <typename T>
MatrixX<T> CalcH(const dynamics::Chain& chain, const VectorX<T>& q,
                 const std::vector<Jacobians<T>>& jacobians) {
  const int n = chain.arm.num_joints();
  const auto poses = CalcPoses(chain, q);
  MatrixX<T> H = MatrixX<T>::Constant(n, n, T(0));
  for (int i = 0; i < n; ++i) {
    const dynamics::Link& link = chain.arm.links[i];
    const Matrix3X<T>& Jc = jacobians[i].point;
    // In the axes of the link, where its inertia is constant.
    const Matrix3X<T> Jw =
        poses[i].R.transpose().lazyProduct(jacobians[i].axes);
    const Matrix3X<T> I_Jw = Lift<T>(link.inertia).lazyProduct(Jw);
    H += Jc.transpose().lazyProduct(Jc * T(link.mass));
    H += Jw.transpose().lazyProduct(I_Jw);
    H(i, i) += T(link.rotor_inertia);
  }
  return H;
}

// Derivative of H by q_k.
MatrixXl CalcHRate(const dynamics::Chain& chain, const Eigen::VectorXd& q,
                   int k) {
  VectorX<Dual1> moving(q.size());
  for (int i = 0; i < q.size(); ++i) moving[i] = {q[i], i == k ? 1.0L : 0.0L};
  return Rates(CalcH(chain, moving, CalcJacobians(chain, moving)));
}

// q along a curve: its value, and twice its first and once its second
// derivative, so that every function of it carries the same.
VectorX<Dual2> Curve(const Eigen::VectorXd& q, const Eigen::VectorXd& qd,
                     const Eigen::VectorXd& qdd) {
  VectorX<Dual2> curve(q.size());
  for (int i = 0; i < q.size(); ++i) {
    curve[i] = {Dual1(q[i], qd[i]), Dual1(qd[i], qdd[i])};
  }
  return curve;
}

// Power that it takes to change the motion of a link.
Real CalcEnergyRate(const dynamics::Link& link, const Pose<Dual2>& pose,
                    const Vector3l& gravity) {
  const Vector3<Dual1> v = Rates(pose * link.com);
  const Vector3<Dual1> omega = AngularVelocity(pose.R);
  const Matrix3<Dual1> R = Values(pose.R);
  const Vector3<Dual1> w = R.transpose() * omega;
  const Dual1 kinetic =
      (v.dot(v) * Dual1(link.mass) + w.dot(Lift<Dual1>(link.inertia) * w)) *
      Dual1(0.5L);
  return kinetic.rate - link.mass * gravity.dot(Values(v));
}

}  // namespace

LagrangeTerms CalcLagrangeTerms(const dynamics::Chain& chain,
                                const Eigen::VectorXd& q,
                                const Eigen::VectorXd& qd,
                                const Eigen::Vector3d& gravity) {
  const int n = chain.arm.num_joints();
  const VectorXl qd_l = qd.cast<Real>();
  const auto jacobians = CalcJacobians<Real>(chain, q.cast<Real>());
  LagrangeTerms terms;
  terms.H = CalcH<Real>(chain, q.cast<Real>(), jacobians);
  terms.J.resize(6, n);
  terms.J << jacobians[n].axes, jacobians[n].point;
  terms.C = VectorXl::Zero(n);
  terms.G = VectorXl::Zero(n);
  for (int k = 0; k < n; ++k) {
    const VectorXl rate_qd = CalcHRate(chain, q, k) * qd_l;
    terms.C += rate_qd * qd_l[k];
    terms.C[k] -= 0.5L * qd_l.dot(rate_qd);
    terms.G -= chain.arm.links[k].mass * jacobians[k].point.transpose() *
               gravity.cast<Real>();
  }
  terms.Jd_qd =
      CalcCarriedMember(chain, q, qd, Eigen::VectorXd::Zero(n)).acceleration;
  return terms;
}

CarriedMember CalcCarriedMember(const dynamics::Chain& chain,
                                const Eigen::VectorXd& q,
                                const Eigen::VectorXd& qd,
                                const Eigen::VectorXd& qdd) {
  const Pose<Dual2> pose = CalcPoses(chain, Curve(q, qd, qdd)).back();
  const Vector3<Dual1> omega = AngularVelocity(pose.R);
  const Vector3<Dual1> v = Rates(pose.p);
  CarriedMember member;
  member.R = Values(Values(pose.R));
  member.P = Values(Values(pose.p));
  member.velocity << Values(omega), Values(v);
  member.acceleration << Rates(omega), Rates(v);
  return member;
}

Real CalcEnergyRate(const dynamics::Chain& chain, const Eigen::VectorXd& q,
                    const Eigen::VectorXd& qd, const Eigen::VectorXd& qdd,
                    const Eigen::Vector3d& gravity) {
  const auto poses = CalcPoses(chain, Curve(q, qd, qdd));
  Real rate = 0;
  for (int i = 0; i < chain.arm.num_joints(); ++i) {
    const dynamics::Link& link = chain.arm.links[i];
    rate += CalcEnergyRate(link, poses[i], gravity.cast<Real>());
    rate += static_cast<Real>(link.rotor_inertia) * qd[i] * qdd[i];
  }
  return rate;
}

}  // namespace support
