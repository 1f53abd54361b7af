#pragma once

#include <vector>

#include "dynamics/chain_terms.h"

namespace dynamics {

// What a chain leaves for the rest of an evaluation when its tip is free
// (q''_open, x''_open) and what it takes to move the tip (Lambda).
template <typename S>
struct OpenChain {
  explicit OpenChain(int num_joints);

  VectorX<S> qdd_open;                    // (N)      q'' with f = 0
  std::vector<SpatialVector<S>> Hinv_JT;  // (N x 6)  rows of H^-1 J^T
  Vector6<S> a_open;                      // (6)      x'' with f = 0
  Matrix6<S> Lambda;                      // (6 x 6)  operational-space inertia,
                                          //          both triangles filled
  Vector6<S> Lambda_a_open;               // (6)      Lambda x''_open
  S margin;  // positive iff H and Lambda^-1 are positive definite (lane-wise)
};

// Work space of CalcOpenChain for N joints.
template <typename S>
struct OpenChainWork {
  explicit OpenChainWork(int num_joints);

  ChainTerms<S> terms;
  VectorX<S> d_inv;                       // (N)      1 / D of H = L D L^T
  std::vector<SpatialVector<S>> Linv_JT;  // (N x 6)  rows of L^-1 J^T
  VectorX<S> Linv_tau;                    // (N)      L^-1 (tau - C - G)
};

// Block OCD of Figure 1, open-chain dynamics [MSO93 (2), (6), (7)]:
//
//   q''_open  = H^-1 (tau - C - G)
//   x''_open  = J' q' + J q''_open
//   Lambda^-1 = J H^-1 J^T
//
// so that a tip force f gives x'' = x''_open - Lambda^-1 f (5).
// q, qd, tau: N values each. Where the chain is singular or q is NaN, `margin`
// says so, in its own lane only; NaN in qd or tau reaches x''_open. No
// allocation; any number of tasks may call it at once, each with its own work
// space.
// Cost: bench row "OCD".
template <typename S>
void CalcOpenChain(const ChainConstants<S>& chain, const S* q, const S* qd,
                   const S* tau, OpenChainWork<S>* work, OpenChain<S>* open);

}  // namespace dynamics
