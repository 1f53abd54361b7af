#pragma once

#include <functional>
#include <vector>

#include "bench/statistics.h"
#include "dynamics/lift.h"
#include "integrators/block_method.h"

// How many steps a method needs.

namespace bench {

// Distance (m) for which execution times are compared.
inline constexpr double kTargetError = 1e-6;

// The error of the lift with one number of steps, without a clock.
struct SweepPoint {
  int steps;
  double error;  // m
};

// The errors of one method over its sweep, and the number of steps for an error
// of 1e-6 m by log-log regression over errors from 5e-8 m to 2e-5 m.
struct MethodSweep {
  integrators::BlockMethod method;
  std::vector<SweepPoint> points;
  PowerLaw fit;
  double steps_at_target;
};

// A multiple of four: then B1PC5, B2PC5 and B4PC5 start from the same five
// values, and whole blocks remain.
inline constexpr int kStepsApart = 4;

// The sweeps of methods over the same plans, started from the plan.
// `make_lift()` gives the lift that is simulated; `show(what, done, all)` is
// called now and then. Throws std::runtime_error, one sentence, if a method does
// not pass through the range.
std::vector<MethodSweep> SweepMethods(
    const std::vector<integrators::BlockMethod>& methods,
    const std::function<dynamics::Lift()>& make_lift,
    const std::function<void(const char*, int, int)>& show);

// The whole number of steps, a multiple of kStepsApart, that reaches the target.
int WholeSteps(const MethodSweep& sweep);

}  // namespace bench
