#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <string>
#include <vector>

// Constant models, all double: what a robot, a grip and a load are. States,
// work space and results live elsewhere, so that many tasks share one model.

namespace dynamics {

enum class JointType { kRevolute, kPrismatic };

// A joint and the link that it moves. The joint frame moves with the link; the
// joint turns about (revolute, rad) or slides along (prismatic, m) its z axis.
struct Link {
  JointType type = JointType::kRevolute;
  // Pose of the joint frame at q = 0 in the joint frame of the link before (in
  // the base frame for the first).
  Eigen::Isometry3d parent_to_joint = Eigen::Isometry3d::Identity();
  double mass = 0;                                    // kg
  Eigen::Vector3d com = Eigen::Vector3d::Zero();      // m, joint frame
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  // kg m^2, about the
                                                      // centre of mass
  double rotor_inertia = 0;  // G^2 Jm, kg m^2 (or kg): adds to H(i, i)
};

// An open arm of N >= 1 joints.
struct ArmModel {
  int num_joints() const { return static_cast<int>(links.size()); }

  std::string name;
  std::vector<Link> links;
  Eigen::Isometry3d tip = Eigen::Isometry3d::Identity();  // in the last joint
                                                          // frame
};

// One row of a table of standard Denavit-Hartenberg parameters, with the
// inertial figures given in the link frame (the frame after the row).
struct DhRow {
  JointType type = JointType::kRevolute;
  double alpha = 0, a = 0, d = 0, theta = 0;  // rad, m, m, rad; q adds to theta
                                              // (revolute) or d (prismatic)
  double mass = 0;
  Eigen::Vector3d com = Eigen::Vector3d::Zero();
  Eigen::Vector3d principal_inertia = Eigen::Vector3d::Zero();
  double rotor_inertia = 0;
};
ArmModel ArmFromDh(std::string name, const std::vector<DhRow>& rows);

// An arm at its place in the world, with its grip on the reference member.
struct Chain {
  ArmModel arm;
  Eigen::Isometry3d base = Eigen::Isometry3d::Identity();  // in the world
  Eigen::Isometry3d grip = Eigen::Isometry3d::Identity();  // reference member
                                                           // in the tip frame
};

// The load. Its frame has its origin in the centre of mass.
struct ReferenceMember {
  double mass = 0;                                    // kg
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  // kg m^2, own axes
};

// m chains that rigidly grasp one reference member [MSO93 section 2].
struct SystemModel {
  int num_chains() const { return static_cast<int>(chains.size()); }

  std::vector<Chain> chains;
  ReferenceMember member;
  Eigen::Vector3d gravity = {0, 0, -9.81};  // m/s^2, world axes
};

// Throws std::invalid_argument, one sentence that names the chain and the
// figure, unless there is at least one chain, every chain has at least one
// joint, poses are finite, and masses and inertias are finite, not negative and
// symmetric, those of the reference member positive.
void CheckModel(const SystemModel& model);

}  // namespace dynamics
