#pragma once

#include <Eigen/Core>

#include "dynamics/model.h"
#include "tests/support/dual.h"

namespace support {

using VectorXl = Eigen::Matrix<Real, Eigen::Dynamic, 1>;
using MatrixXl = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;
using Vector3l = Eigen::Matrix<Real, 3, 1>;
using Vector6l = Eigen::Matrix<Real, 6, 1>;
using Matrix3l = Eigen::Matrix<Real, 3, 3>;

// The terms of an open chain, tau = H q'' + C + G, and of the reference member
// as the chain carries it: x' = J q', x'' = J q'' + Jd_qd, at its centre of
// mass in world axes, angular part first, classical accelerations.
struct LagrangeTerms {
  MatrixXl H;      // (N x N)  inertia matrix, both triangles
  VectorXl C;      // (N)      velocity products
  VectorXl G;      // (N)      gravity
  MatrixXl J;      // (6 x N)
  Vector6l Jd_qd;  // (6)
};

// The terms by Lagrange's equations, sharing nothing with dynamics/ but the
// model: poses are products of transforms; every Jacobian is their derivative
// by automatic differentiation; and
//
//   H = sum_i m_i Jc_i^T Jc_i + Jw_i^T I_i Jw_i
//   C = H' q' - 1/2 grad_q (q'^T H q')
//   G = grad_q V,  V = -sum_i m_i g . c_i
//
// Costs N^2 evaluations of all poses: for tests.
LagrangeTerms CalcLagrangeTerms(const dynamics::Chain& chain,
                                const Eigen::VectorXd& q,
                                const Eigen::VectorXd& qd,
                                const Eigen::Vector3d& gravity);

// Motion of the reference member as the chain carries it.
struct CarriedMember {
  Matrix3l R;             // axes, in world axes
  Vector3l P;             // centre of mass, m
  Vector6l velocity;      // [omega; v]
  Vector6l acceleration;  // [omega'; v']
};
CarriedMember CalcCarriedMember(const dynamics::Chain& chain,
                                const Eigen::VectorXd& q,
                                const Eigen::VectorXd& qd,
                                const Eigen::VectorXd& qdd);

// Rate of change (W) of the kinetic and potential energy of the chain's links
// and rotors, body by body along the curve with the given derivatives.
Real CalcEnergyRate(const dynamics::Chain& chain, const Eigen::VectorXd& q,
                    const Eigen::VectorXd& qd, const Eigen::VectorXd& qdd,
                    const Eigen::Vector3d& gravity);

}  // namespace support
