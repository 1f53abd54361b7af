#pragma once

#include "dynamics/open_chain.h"

namespace dynamics {

// Block CCD of Figure 1, closed-chain dynamics [MSO93 (8), (2)]:
//
//   f_k   = Lambda_k (x_k,open'' - a_r)        grasp wrench
//   q_k'' = q_k,open'' - H_k^-1 J_k^T f_k
//
// f [moment; force] (N m, N): what the tip exerts on the reference member,
// about P in world axes. qdd: N values. No allocation.
// Cost: bench row "CCD".
template <typename S>
void CalcClosedChain(const OpenChain<S>& open, const Vector6<S>& a_r,
                     Vector6<S>* f, S* qdd);

}  // namespace dynamics
