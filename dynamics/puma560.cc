#include "dynamics/puma560.h"

#include <numbers>

namespace dynamics {

ArmModel Puma560(bool rotor_inertia) {
  constexpr double kRight = std::numbers::pi / 2;
  struct Row {
    double alpha, a, d, mass;
    Eigen::Vector3d com, inertia;
    double Jm, G;
  };
  // alpha (rad), a (m), d (m), mass (kg), centre of mass in the link frame (m),
  // principal inertia about it (kg m^2), rotor inertia (kg m^2), gear ratio
  const Row rows[] = {
      {kRight, 0, 0, 0, {0, 0, 0}, {0, 0.35, 0}, 200e-6, -62.6111},
      {0,
       0.4318,
       0,
       17.4,
       {-0.3638, 0.006, 0.2275},
       {0.13, 0.524, 0.539},
       200e-6,
       107.815},
      {-kRight,
       0.0203,
       0.15005,
       4.8,
       {-0.0203, -0.0141, 0.070},
       {0.066, 0.086, 0.0125},
       200e-6,
       -53.7063},
      {kRight,
       0,
       0.4318,
       0.82,
       {0, 0.019, 0},
       {1.8e-3, 1.3e-3, 1.8e-3},
       33e-6,
       76.0364},
      {-kRight, 0, 0, 0.34, {0, 0, 0}, {0.3e-3, 0.4e-3, 0.3e-3}, 33e-6, 71.923},
      {0,
       0,
       0.05625,
       0.09,
       {0, 0, 0.032 - 0.05625},
       {0.15e-3, 0.15e-3, 0.04e-3},
       33e-6,
       76.686},
  };
  std::vector<DhRow> table;
  for (const Row& row : rows) {
    table.push_back(
        {.alpha = row.alpha,
         .a = row.a,
         .d = row.d,
         .mass = row.mass,
         .com = row.com,
         .principal_inertia = row.inertia,
         .rotor_inertia = rotor_inertia ? row.G * row.G * row.Jm : 0.0});
  }
  return ArmFromDh("PUMA 560", table);
}

}  // namespace dynamics
