#pragma once

#include "dynamics/model.h"

namespace dynamics {

// The PUMA 560 in standard Denavit-Hartenberg form, masses and inertias of
// Armstrong, Khatib & Burdick 1986 ("The explicit dynamic model and inertial
// parameters of the PUMA 560 arm"), with a flange of 0.05625 m. With
// `rotor_inertia`, the motors' G^2 Jm add to the diagonal of H.
ArmModel Puma560(bool rotor_inertia = false);

}  // namespace dynamics
