#pragma once

#include "dynamics/chain_terms.h"
#include "dynamics/model.h"

namespace dynamics {

// Pose of the reference member in the world as the chain carries it with the
// joint positions q (N; rad or m).
Eigen::Isometry3d CalcMemberPose(const Chain& chain, const Eigen::VectorXd& q);

// J (6 x N), angular part first, of the member's centre of mass, world axes.
Eigen::MatrixXd Jacobian(const ChainTerms<double>& terms);

// The six joints of a chain that carry the reference member from q on, in
// ascending order; the other N - 6 are held. They are the ones that column
// pivoting of J picks first, so that they are well conditioned at q. Throws
// std::runtime_error ("... is at a singularity ..." or "... has 4 joints ...")
// if there are no six independent ones; `where` begins the sentence.
std::vector<int> ChooseCarryingJoints(const Chain& chain,
                                      const Eigen::VectorXd& q,
                                      const std::string& where);

// Inverse kinematics: joint positions, near the guess `q`, with which the chain
// carries the reference member at `target` (in the world), to rounding error.
// Newton's method on the six `joints`; the others stay. Throws
// std::runtime_error, one sentence that begins with `where` and says by how
// much the target was missed, when it does not converge: an unreachable grip.
Eigen::VectorXd SolveInverseKinematics(const Chain& chain,
                                       const Eigen::Isometry3d& target,
                                       const std::vector<int>& joints,
                                       Eigen::VectorXd q,
                                       const std::string& where);

// Inverse dynamics of a chain that exerts f [moment; force] on the reference
// member, about P in world axes: tau = H q'' + C + G + J^T f [MSO93 (1)].
// `terms` as CalcChainTerms leaves them. Returns N torques (N m or N).
Eigen::VectorXd CalcInverseDynamics(const ChainTerms<double>& terms,
                                    const Eigen::VectorXd& qdd,
                                    const Vector6<double>& f);

}  // namespace dynamics
