#include "tests/support/kkt_oracle.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

namespace support {

MemberTerms CalcMemberTerms(const dynamics::SystemModel& model,
                            const SystemState& state) {
  const Real mass = model.member.mass;
  const Matrix3l R = state.Q.cast<Real>().normalized().toRotationMatrix();
  const Matrix3l I = R * model.member.inertia.cast<Real>() * R.transpose();
  const Vector3l omega = state.omega.cast<Real>();
  MemberTerms terms;
  terms.I_r.setZero();
  terms.I_r.topLeftCorner<3, 3>() = I;
  terms.I_r.bottomRightCorner<3, 3>() = mass * Matrix3l::Identity();
  terms.b_minus_g << omega.cross(I * omega), -mass * model.gravity.cast<Real>();
  return terms;
}

KktSolution SolveKkt(const dynamics::SystemModel& model,
                     const SystemState& state,
                     const std::vector<Eigen::VectorXd>& tau) {
  const int m = model.num_chains();
  int size = 6 * m + 6;
  for (const dynamics::Chain& chain : model.chains) {
    size += chain.arm.num_joints();
  }
  MatrixXl K = MatrixXl::Zero(size, size);
  VectorXl rhs(size);
  const int a = size - 6;  // where a_r begins; q_k'' and f_k begin at i
  for (int k = 0, i = 0; k < m; ++k) {
    const LagrangeTerms terms = CalcLagrangeTerms(model.chains[k], state.q[k],
                                                  state.qd[k], model.gravity);
    const int n = static_cast<int>(terms.G.size());
    const int f = i + n;
    K.block(i, i, n, n) = terms.H;
    K.block(i, f, n, 6) = terms.J.transpose();
    K.block(f, i, 6, n) = terms.J;
    K.block(f, a, 6, 6).diagonal().setConstant(-1);
    K.block(a, f, 6, 6).diagonal().setConstant(1);
    rhs.segment(i, n) = tau[k].cast<Real>() - terms.C - terms.G;
    rhs.segment(f, 6) = -terms.Jd_qd;
    i = f + 6;
  }
  const MemberTerms member = CalcMemberTerms(model, state);
  K.block(a, a, 6, 6) = -member.I_r;
  rhs.tail(6) = member.b_minus_g;

  const VectorXl x = K.fullPivLu().solve(rhs);
  KktSolution solution;
  for (int k = 0, i = 0; k < m; ++k) {
    const int n = model.chains[k].arm.num_joints();
    solution.qdd.push_back(x.segment(i, n));
    solution.f.push_back(x.segment(i + n, 6));
    i += n + 6;
  }
  solution.a_r = x.tail(6);
  return solution;
}

}  // namespace support
