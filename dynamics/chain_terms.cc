#include "dynamics/chain_terms.h"

#include <algorithm>

#include "dynamics/chain_terms-inl.h"

namespace dynamics {
namespace {

// Writes lane `lane` of every element of `target`.
template <typename S, int kRows, int kCols>
void SetLanes(Eigen::Matrix<S, kRows, kCols>* target, int lane,
              const Eigen::Matrix<double, kRows, kCols>& value) {
  for (int i = 0; i < target->size(); ++i) {
    SetLane(target->data() + i, lane, value.data()[i]);
  }
}

template <typename S>
void SetJointLane(const Link& link, const Eigen::Isometry3d& parent_to_joint,
                  int lane, typename ChainConstants<S>::Joint* joint) {
  joint->type = link.type;
  SetLanes<S, 3, 3>(&joint->R_parent, lane, parent_to_joint.linear());
  SetLanes<S, 3, 1>(&joint->p_parent, lane, parent_to_joint.translation());
  SetLane(&joint->mass, lane, link.mass);
  SetLanes<S, 3, 1>(&joint->com, lane, link.com);
  SetLanes<S, 3, 3>(&joint->inertia, lane, link.inertia);
  SetLane(&joint->rotor_inertia, lane, link.rotor_inertia);
}

}  // namespace

template <typename S>
ChainTerms<S>::ChainTerms(int num_joints)
    : R(num_joints),
      p(num_joints),
      I(num_joints),
      F(num_joints),
      J(num_joints),
      H(num_joints, num_joints),
      bias(num_joints) {}

bool SameJointTypes(const ArmModel& a, const ArmModel& b) {
  if (a.num_joints() != b.num_joints()) return false;
  for (int i = 0; i < a.num_joints(); ++i) {
    if (a.links[i].type != b.links[i].type) return false;
  }
  return true;
}

template <typename S>
ChainConstants<S> MakeChainConstants(const std::vector<const Chain*>& chains,
                                     const Eigen::Vector3d& gravity) {
  ChainConstants<S> constants;
  const int n = chains.at(0)->arm.num_joints();
  constants.joints.resize(n);
  for (int lane = 0; lane < kLanesOf<S>; ++lane) {
    const std::size_t last = chains.size() - 1;
    const Chain& chain = *chains[std::min<std::size_t>(lane, last)];
    for (int i = 0; i < n; ++i) {
      const Link& link = chain.arm.links[i];
      SetJointLane<S>(
          link,
          i == 0 ? chain.base * link.parent_to_joint : link.parent_to_joint,
          lane, &constants.joints[i]);
    }
    const Eigen::Isometry3d member = chain.arm.tip * chain.grip;
    SetLanes<S, 3, 3>(&constants.R_member, lane, member.linear());
    SetLanes<S, 3, 1>(&constants.p_member, lane, member.translation());
    SetLanes<S, 3, 1>(&constants.gravity, lane, gravity);
  }
  return constants;
}

template <typename S>
void CalcChainTerms(const ChainConstants<S>& chain, const S* q, const S* qd,
                    ChainTerms<S>* terms) {
  internal::CalcChainTermsInline(chain, q, qd, terms);
}

#define DYNAMICS_INSTANTIATE(S)                                              \
  template struct ChainTerms<S>;                                             \
  template ChainConstants<S> MakeChainConstants(                             \
      const std::vector<const Chain*>&, const Eigen::Vector3d&);             \
  template void CalcChainTerms(const ChainConstants<S>&, const S*, const S*, \
                               ChainTerms<S>*);
DYNAMICS_INSTANTIATE(double)
DYNAMICS_INSTANTIATE(Pack<4>)
#undef DYNAMICS_INSTANTIATE

}  // namespace dynamics
