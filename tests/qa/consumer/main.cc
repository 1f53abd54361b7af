// Uses each installed library once; returns 0 if all did as they say.

#include <iostream>
#include <vector>

#include "dynamics/closed_chain_system.h"
#include "dynamics/lift.h"
#include "integrators/integration.h"
#include "macrotask/barrier.h"
#include "macrotask/task.h"

// What task 0 writes before the barrier, task 1 reads after it.
bool BarrierOrdersTwoTasks() {
  macrotask::Barrier barrier(2);
  int written = 0;
  int read = 0;
  macrotask::RunTasks(2, [&](int task) {
    if (task == 0) written = 7;
    barrier.Sync();
    if (task == 1) read = written;
  });
  return read == 7;
}

// Two arms hold their load still under the torques that a plan says, simulated
// by two tasks.
bool ArmsHoldTheirLoad() {
  const dynamics::Lift lift = dynamics::PumaLift(2);
  const auto still = [&](double) { return lift.motion(0); };
  const dynamics::Plan plan =
      dynamics::MakePlan(lift.model, still, 0.01, 20, lift.q_guess);
  const dynamics::TorqueTable torques(plan.step, plan.tau);
  const dynamics::ClosedChainSystem system(lift.model, torques,
                                           dynamics::Lanes::kFour);
  integrators::IntegrationOptions options;
  options.method = integrators::B2PC5();
  options.step = plan.step;
  options.num_steps = 20;
  options.figure = integrators::Figure::kFigure8;
  options.partition = {.chain_tasks = 1, .integration_tasks = 2};
  integrators::Integration integration(system, options);

  std::vector<double> state;  // [q; q'] of each chain, then the member
  for (const auto& chain : plan.states) {
    state.insert(state.end(), chain.col(0).begin(), chain.col(0).end());
  }
  state.insert(state.end(), plan.member.col(0).begin(),
               plan.member.col(0).end());
  const auto result = integration.Run(state);
  const auto member = dynamics::UnpackMember(
      result.state.data() + integration.layout().common_offset());
  return (member.p - lift.motion(0).pose.translation()).norm() < 1e-9;
}

int main() {
  if (!BarrierOrdersTwoTasks()) {
    std::cerr << "macrotask: the barrier does not order two tasks\n";
    return 1;
  }
  if (!ArmsHoldTheirLoad()) {
    std::cerr << "dynamics, integrators: the load moved\n";
    return 1;
  }
  return 0;
}
