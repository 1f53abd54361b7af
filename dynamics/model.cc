#include "dynamics/model.h"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace dynamics {
namespace {

// Link frame after a standard Denavit-Hartenberg row, in the joint frame:
// what follows the rotation by q about, or the translation by q along, z.
Eigen::Isometry3d AfterJoint(const DhRow& row) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.rotate(Eigen::AngleAxisd(row.theta, Eigen::Vector3d::UnitZ()));
  pose.translate(Eigen::Vector3d(row.a, 0, row.d));
  pose.rotate(Eigen::AngleAxisd(row.alpha, Eigen::Vector3d::UnitX()));
  return pose;
}

[[noreturn]] void Reject(const std::string& where, const std::string& what) {
  throw std::invalid_argument(where + ": " + what);
}

void CheckMass(const std::string& where, double mass,
               const Eigen::Matrix3d& inertia) {
  if (!std::isfinite(mass) || mass < 0) {
    Reject(where, "the mass must be a finite number of kg, not below zero");
  }
  // Published inertias have a zero here and there; rounding may make it less.
  const bool symmetric =
      inertia.allFinite() && inertia.isApprox(inertia.transpose());
  if (!symmetric ||
      inertia.selfadjointView<Eigen::Lower>().eigenvalues().minCoeff() <
          -1e-12 * inertia.norm()) {
    Reject(where,
           "the inertia must be a finite, symmetric matrix, not below zero");
  }
}

void CheckLink(const std::string& where, const Link& link) {
  CheckMass(where, link.mass, link.inertia);
  if (!link.com.allFinite() || !link.parent_to_joint.matrix().allFinite()) {
    Reject(where, "the centre of mass and the joint frame must be finite");
  }
  if (!std::isfinite(link.rotor_inertia) || link.rotor_inertia < 0) {
    Reject(where, "the rotor inertia must be finite, not below zero");
  }
}

}  // namespace

ArmModel ArmFromDh(std::string name, const std::vector<DhRow>& rows) {
  ArmModel arm;
  arm.name = std::move(name);
  Eigen::Isometry3d parent_to_joint = Eigen::Isometry3d::Identity();
  for (const DhRow& row : rows) {
    const Eigen::Isometry3d link_frame = AfterJoint(row);
    const Eigen::Matrix3d R = link_frame.linear();
    Link link;
    link.type = row.type;
    link.parent_to_joint = parent_to_joint;
    link.mass = row.mass;
    link.com = link_frame * row.com;
    link.inertia = R * row.principal_inertia.asDiagonal() * R.transpose();
    link.rotor_inertia = row.rotor_inertia;
    arm.links.push_back(link);
    parent_to_joint = link_frame;
  }
  arm.tip = parent_to_joint;
  return arm;
}

void CheckModel(const SystemModel& model) {
  if (model.chains.empty()) Reject("the system", "expected at least one chain");
  for (int k = 0; k < model.num_chains(); ++k) {
    const ArmModel& arm = model.chains[k].arm;
    const std::string chain = "chain " + std::to_string(k);
    if (arm.links.empty()) Reject(chain, "expected at least one joint");
    for (int i = 0; i < arm.num_joints(); ++i) {
      CheckLink(chain + ", link " + std::to_string(i + 1), arm.links[i]);
    }
    for (const auto& pose :
         {model.chains[k].base, model.chains[k].grip, arm.tip}) {
      if (!pose.matrix().allFinite()) {
        Reject(chain, "the poses of base, tip and grip must be finite");
      }
    }
  }
  if (!model.gravity.allFinite()) Reject("gravity", "must be finite");
  CheckMass("the reference member", model.member.mass, model.member.inertia);
  if (!(model.member.mass > 0) ||
      !(model.member.inertia.selfadjointView<Eigen::Lower>()
            .eigenvalues()
            .minCoeff() > 0)) {
    Reject("the reference member", "mass and inertia must be positive");
  }
}

}  // namespace dynamics
