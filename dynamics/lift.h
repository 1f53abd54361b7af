#pragma once

#include <vector>

#include "dynamics/model.h"
#include "dynamics/plan.h"

namespace dynamics {

// The experiment of [MSO93 section 5]: arms that stand around a load lift it
// straight up.
struct Lift {
  SystemModel model;
  LoadMotion motion;
  double duration;                       // s
  std::vector<Eigen::VectorXd> q_guess;  // (m)(6), near the start
  Eigen::Vector3d end;                   // of P, m
};

// `num_chains` PUMA 560 at equal angles around the z axis lift 4 kg by 0.8 m in
// one second; the paper's has four. It does not print its geometry: this one
// keeps clear of singularities (|det J| >= 0.0458 along the path). Shoulders
// 0.75625 m from the axis, facing it; grippers horizontal, pointing inward, 0.2
// m from the load's centre of mass, which rises from z = -0.6 m to 0.2 m.
Lift PumaLift(int num_chains = 4, bool rotor_inertia = false);

}  // namespace dynamics
