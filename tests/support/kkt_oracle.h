#pragma once

#include <vector>

#include "tests/support/lagrange_oracle.h"

namespace support {

// State of m chains and of the reference member that they hold.
struct SystemState {
  std::vector<Eigen::VectorXd> q;   // (m)(N_k)  rad or m
  std::vector<Eigen::VectorXd> qd;  // (m)(N_k)
  Eigen::Quaterniond Q;             // member's axes to those of the world
  Eigen::Vector3d p;                // its centre of mass, world, m
  Eigen::Vector3d omega;            // world axes, rad/s
  Eigen::Vector3d v;                // of the centre of mass, world axes, m/s
};

struct KktSolution {
  std::vector<VectorXl> qdd;  // (m)(N_k)
  std::vector<Vector6l> f;    // (m)(6)  [moment; force] on the member
  Vector6l a_r;               // (6)     [omega'; v']
};

// All accelerations and tip forces at once, from one dense linear system in
// q_k'', f_k and a_r, factorized with complete pivoting:
//
//   H_k q_k'' + J_k^T f_k    = tau_k - C_k - G_k        [MSO93 (1)]
//   J_k q_k''          - a_r = -J_k' q_k'               [MSO93 (4), (8)]
//   sum_k f_k      - I_r a_r = b_r - g_r                [MSO93 (9)]
//
// Nothing is eliminated, so Lambda_k^-1 never appears and its condition (2e5
// for a PUMA) costs no digits that the long doubles do not have to spare.
KktSolution SolveKkt(const dynamics::SystemModel& model,
                     const SystemState& state,
                     const std::vector<Eigen::VectorXd>& tau);

// I_r (6 x 6) about the centre of mass in world axes, and b_r - g_r.
struct MemberTerms {
  Eigen::Matrix<Real, 6, 6> I_r;
  Vector6l b_minus_g;
};
MemberTerms CalcMemberTerms(const dynamics::SystemModel& model,
                            const SystemState& state);

}  // namespace support
