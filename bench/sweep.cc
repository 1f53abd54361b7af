#include "bench/sweep.h"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <stdexcept>

#include "bench/lift_case.h"
#include "dynamics/closed_chain_system.h"
#include "integrators/integration.h"

namespace bench {
namespace {

using integrators::BlockMethod;
using Lifts = std::vector<std::unique_ptr<LiftCase>>;

// Between these numbers of steps the errors of all three methods pass through
// the range of the regression.
constexpr int kFirstSteps = 32;
constexpr int kLastSteps = 200;
constexpr Interval kErrorRange = {5e-8, 2e-5};  // m

// Infinite where a method is so far off that the arms run into a singularity.
double ErrorOf(const LiftCase& lift, integrators::Integration* integration) {
  try {
    return lift.Error(integration->RunFrom(lift.Planned()).state);
  } catch (const integrators::IntegrationError&) {
    return std::numeric_limits<double>::infinity();
  }
}

MethodSweep Sweep(const BlockMethod& method, const Lifts& lifts) {
  MethodSweep sweep = {
      .method = method, .points = {}, .fit = {}, .steps_at_target = 0};
  std::vector<double> steps, errors;
  for (const auto& lift : lifts) {
    const dynamics::ClosedChainSystem system(
        lift->lift().model, lift->torques(), dynamics::Lanes::kFour);
    integrators::Integration integration(system,
                                         {.method = method,
                                          .step = lift->step(),
                                          .num_steps = lift->num_steps()});
    const double error = ErrorOf(*lift, &integration);
    sweep.points.push_back({lift->num_steps(), error});
    const bool in_range = error >= kErrorRange.low && error <= kErrorRange.high;
    if (!in_range) continue;
    steps.push_back(lift->num_steps());
    errors.push_back(error);
  }
  if (steps.size() < 2) {
    throw std::runtime_error(fmt::format(
        "{} has fewer than two errors from {} m to {} m between {} and {} "
        "steps: expected a method whose steps for {} m can be told",
        method.name(), kErrorRange.low, kErrorRange.high, kFirstSteps,
        kLastSteps, kTargetError));
  }
  sweep.fit = FitPowerLaw(steps, errors);
  sweep.steps_at_target = sweep.fit.X(kTargetError);
  return sweep;
}

}  // namespace

std::vector<MethodSweep> SweepMethods(
    const std::vector<BlockMethod>& methods,
    const std::function<dynamics::Lift()>& make_lift,
    const std::function<void(const char*, int, int)>& show) {
  Lifts lifts;
  for (int steps = kFirstSteps; steps <= kLastSteps; steps += kStepsApart) {
    show("plan", steps - kFirstSteps, kLastSteps - kFirstSteps);
    lifts.push_back(std::make_unique<LiftCase>(make_lift(), steps));
  }
  std::vector<MethodSweep> sweeps;
  for (const BlockMethod& method : methods) {
    show("sweep", static_cast<int>(sweeps.size()),
         static_cast<int>(methods.size()));
    sweeps.push_back(Sweep(method, lifts));
  }
  return sweeps;
}

int WholeSteps(const MethodSweep& sweep) {
  return kStepsApart *
         static_cast<int>(std::ceil(sweep.steps_at_target / kStepsApart));
}

}  // namespace bench
