#pragma once

#include <vector>

#include "dynamics/model.h"
#include "dynamics/pack.h"
#include "dynamics/spatial.h"

namespace dynamics {

template <typename S>
using VectorX = Eigen::Matrix<S, Eigen::Dynamic, 1>;
template <typename S>
using MatrixX =
    Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// What the dynamics read of a chain, in the scalar type they compute with: a
// lane each for as many chains, whose joints are of the same number and types.
template <typename S>
struct ChainConstants {
  struct Joint {
    JointType type;
    Matrix3<S> R_parent;  // (3 x 3)  joint axes at q = 0, in the parent's axes
    Vector3<S> p_parent;  // (3)      joint origin, in the parent's frame, m
    S mass;               //          kg
    Vector3<S> com;       // (3)      joint frame, m
    Matrix3<S> inertia;   // (3 x 3)  about the centre of mass, joint axes
    S rotor_inertia;      //          G^2 Jm
  };
  int num_joints() const { return static_cast<int>(joints.size()); }

  std::vector<Joint> joints;  // (N)  the first one's parent is the world
  Matrix3<S> R_member;        // (3 x 3)  reference member's axes and
  Vector3<S> p_member;        // (3)      origin P, in the last joint's frame
  Vector3<S> gravity;         // (3)      world axes, m/s^2
};

// Work space of one evaluation of N joints, and the terms that it leaves. All
// spatial quantities are about P in world axes (see spatial.h).
template <typename S>
struct ChainTerms {
  explicit ChainTerms(int num_joints);

  std::vector<Matrix3<S>> R;         // (N)  joint axes in world axes
  std::vector<Vector3<S>> p;         // (N)  joint origins, m
  std::vector<SpatialInertia<S>> I;  // (N)  link, then composite, inertia
  std::vector<SpatialVector<S>> F;   // (N)  link, then composite, bias force

  Vector3<S> P;                     // (3)  centre of mass of the member, m
  std::vector<SpatialVector<S>> J;  // (N)  column i of the Jacobian
  MatrixX<S> H;                     // (N x N)  inertia matrix, lower triangle
  VectorX<S> bias;                  // (N)  C + G, N m
  SpatialVector<S> velocity;        // J q', of the member at P  [MSO93 (3)]
  SpatialVector<S> Jd_qd;           // J' q', classical acceleration at P
};

// Whether the two can share a pack: the same joint types in the same order.
bool SameJointTypes(const ArmModel& a, const ArmModel& b);

// Constants of the given chains, lane l for chains[l]; the last one fills
// the lanes that are left over. Requires 1 <= chains.size() <= kLanesOf<S>, all
// with the same joint types.
template <typename S>
ChainConstants<S> MakeChainConstants(const std::vector<const Chain*>& chains,
                                     const Eigen::Vector3d& gravity);

// Inertia matrix, Jacobian, and the terms of velocity and gravity of one open
// chain, [MSO93 (1), (3), (4)]: Newton-Euler with q'' = 0 outward
// ([Featherstone08] chapter 5), composite bodies inward (chapter 6).
//
//   tau = H q'' + bias  for an arm with a free tip
//
// q, qd: N values each (rad or m, and per second). No allocation; any number
// of tasks may call it at once, each with its own `terms`.
template <typename S>
void CalcChainTerms(const ChainConstants<S>& chain, const S* q, const S* qd,
                    ChainTerms<S>* terms);

}  // namespace dynamics
