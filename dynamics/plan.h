#pragma once

#include <functional>
#include <vector>

#include "dynamics/model.h"
#include "dynamics/reference_member.h"
#include "dynamics/torques.h"

namespace dynamics {

// Where the reference member is to be, and how it is to move, at one time.
struct MemberMotion {
  Eigen::Isometry3d pose;        // of the member's frame, in the world
  Vector6<double> velocity;      // [omega; v] of P, world axes, rad/s and m/s
  Vector6<double> acceleration;  // [omega'; v'], classical
};

// A motion of the load as a function of time (s).
using LoadMotion = std::function<MemberMotion(double t)>;

// Straight from `start` to `end` (m, world axes) in `duration` seconds, at rest
// before and after, with the quintic time law 10 s^3 - 15 s^4 + 6 s^5; the
// orientation stays.
LoadMotion StraightLift(const Eigen::Vector3d& start,
                        const Eigen::Vector3d& end, double duration);

// A load motion turned into what every chain does: the torque profile that
// produces the motion, and the exact states along it. Column n of every matrix
// is the time n * step.
struct Plan {
  int num_times() const { return static_cast<int>(member.cols()); }

  double step;                          // s
  std::vector<Eigen::MatrixXd> states;  // (m)(2 N_k x times)  [q; q']
  std::vector<Eigen::MatrixXd> rates;   // (m)(2 N_k x times)  [q'; q'']
  std::vector<Eigen::MatrixXd> tau;     // (m)(N_k x times)
  std::vector<Eigen::MatrixXd> f;       // (m)(6 x times)  tip forces
  Eigen::MatrixXd member;               // (13 x times)  [Q; p; omega; v]
  Eigen::MatrixXd member_rate;          // (13 x times)
};

// Plans `num_steps` steps. The load is shared equally: f_k = (I_r a_r + b_r -
// g_r) / m [MSO93 (9)]; torques by (1). `q_guess[k]` (N_k) is near the joint
// positions at t = 0; from there each time starts at the one before. A chain of
// more than six joints holds those that ChooseCarryingJoints leaves.
// Throws std::runtime_error, one sentence with the chain and the time, if a
// grip is unreachable or a chain singular.
Plan MakePlan(const SystemModel& model, const LoadMotion& motion, double step,
              int num_steps, const std::vector<Eigen::VectorXd>& q_guess);

}  // namespace dynamics
