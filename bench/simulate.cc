#include "bench/simulate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <stdexcept>
#include <utility>

#include "bench/breakdown.h"
#include "bench/breakdown_run.h"
#include "bench/lift_case.h"
#include "bench/output_file.h"
#include "dynamics/kinematics.h"
#include "macrotask/placement.h"
#include "macrotask/trace.h"

namespace bench {
namespace {

using dynamics::MemberState;

std::vector<Eigen::VectorXd> ChainStates(
    const dynamics::ClosedChainSystem& system, const double* state) {
  std::vector<Eigen::VectorXd> states;
  for (int k = 0; k < system.num_chains(); ++k) {
    const int size = system.chain_size(k);
    states.push_back(Eigen::Map<const Eigen::VectorXd>(state, size));
    state += size;
  }
  return states;
}

// How far the member, as a chain carries it, is from where it is.
struct Drift {
  double position = 0;  // m
  double rotation = 0;  // rad
};
std::vector<Drift> DriftOfGrips(const dynamics::ClosedChainSystem& system,
                                const std::vector<double>& state,
                                const MemberState<double>& member) {
  const Eigen::Matrix3d axes = dynamics::MemberAxes(member.Q);
  const auto chain_states = ChainStates(system, state.data());
  std::vector<Drift> drifts;
  for (std::size_t k = 0; k < chain_states.size(); ++k) {
    const Eigen::VectorXd q = chain_states[k].head(chain_states[k].size() / 2);
    const Eigen::Isometry3d carried =
        dynamics::CalcMemberPose(system.model().chains[k], q);
    const Eigen::AngleAxisd turn(
        Eigen::Matrix3d(carried.linear() * axes.transpose()));
    drifts.push_back({(carried.translation() - member.p).norm(), turn.angle()});
  }
  return drifts;
}

std::string TrajectoryHeader(const dynamics::ClosedChainSystem& system) {
  std::string header =
      "t,Q_w,Q_x,Q_y,Q_z,p_x,p_y,p_z,omega_x,omega_y,omega_z,v_x,v_y,v_z";
  for (int k = 0; k < system.num_chains(); ++k) {
    const int n = system.chain_size(k) / 2;
    for (const char* name : {"q", "qd", "tau"}) {
      for (int i = 1; i <= n; ++i) {
        header += fmt::format(",{}_{}_{}", name, k, i);
      }
    }
    for (const char* name : {"n_x", "n_y", "n_z", "f_x", "f_y", "f_z"}) {
      header += fmt::format(",{}_{}", name, k);
    }
  }
  return header + "\n";
}

// One row a grid point: time, reference member, and for every chain positions,
// rates, torques and the tip force (moment n, force f, about the member's
// centre of mass, world axes).
std::string TrajectoryCsv(const dynamics::ClosedChainSystem& system,
                          const integrators::Integration& integration,
                          double step) {
  std::string csv = TrajectoryHeader(system);
  auto out = std::back_inserter(csv);
  const auto append = [&](double x) { fmt::format_to(out, ",{}", x); };
  const std::size_t size = integration.layout().size();
  const std::vector<double>& trajectory = integration.trajectory();
  for (std::size_t n = 0; n < trajectory.size() / size; ++n) {
    const double* state = trajectory.data() + n * size;
    const double* member = state + integration.layout().common_offset();
    const double t = static_cast<double>(n) * step;
    const auto chain_states = ChainStates(system, state);
    const auto accelerations = dynamics::CalcClosedChainAccelerations(
        system, t, chain_states, dynamics::UnpackMember(member));
    fmt::format_to(out, "{}", t);
    std::for_each_n(member, dynamics::kMemberStateSize, append);
    for (std::size_t k = 0; k < chain_states.size(); ++k) {
      for (const double x : chain_states[k]) append(x);
      for (const double x : accelerations.tau[k]) append(x);
      for (const double x : accelerations.f[k]) append(x);
    }
    csv += '\n';
  }
  return csv;
}

std::string Report(const SimulateOptions& options, const LiftCase& lift,
                   const dynamics::ClosedChainSystem& system,
                   const integrators::IntegrationResult& result) {
  const MemberState<double> member = lift.Member(result.state);
  std::string positions, rotations;
  for (const Drift& drift : DriftOfGrips(system, result.state, member)) {
    positions += fmt::format("{:.2e} ", drift.position);
    rotations += fmt::format("{:.2e} ", drift.rotation);
  }
  const int tasks = options.partition.num_tasks();
  const double duration = lift.lift().duration;
  return fmt::format(
      "method:            {}, {} steps of {} s\n"
      "tasks:             {} ({}: m^ = {}, p^ = {}), {}\n"
      "waiting:           {}\n"
      "lanes:             {}\n"
      "final position:    {:.12f} {:.12f} {:.12f} m\n"
      "final orientation: {:.12f} {:.12f} {:.12f} {:.12f} (w x y z)\n"
      "error:             {:.3e} m from the planned end\n"
      "drift of grips:    {}m\n"
      "                   {}rad\n"
      "evaluations:       {}\n"
      "time:              {:.1f} us (start {:.1f} us)\n"
      "real-time factor:  {:.0f}\n",
      options.method, lift.num_steps(), lift.step(), tasks,
      Name(options.figure), options.partition.chain_tasks,
      options.partition.integration_tasks,
      macrotask::Placement(tasks).ToString(),
      Name(options.wait.For(tasks).kind), static_cast<int>(options.lanes),
      member.p[0], member.p[1], member.p[2], member.Q[0], member.Q[1],
      member.Q[2], member.Q[3], lift.Error(result.state), positions, rotations,
      result.evaluations, result.seconds() * 1e6, result.start_seconds * 1e6,
      duration / result.seconds());
}

// Returns the line of the report.
std::string WriteHistory(const macrotask::Trace& trace,
                         const std::string& path) {
  macrotask::WriteTrace(trace, path);
  std::size_t num_records = 0;
  std::uint64_t num_lost = 0;
  for (const macrotask::TraceBuffer& buffer : trace.buffers) {
    num_records += buffer.records.size();
    num_lost += buffer.num_lost;
  }
  return fmt::format(
      "history trace:     {} records in {}, {} older ones lost\n", num_records,
      path, num_lost);
}

}  // namespace

std::string Simulate(const SimulateOptions& options) {
  const auto method = integrators::ParseBlockMethod(options.method);
  constexpr int kMostChains = 10'000;  // whose models fit in memory
  if (options.num_chains < 1 || options.num_chains > kMostChains) {
    throw std::invalid_argument(fmt::format("{} chains: expected 1 to {}",
                                            options.num_chains, kMostChains));
  }
  for (const std::string& path : {options.output, options.trace}) {
    if (!path.empty()) CheckOutput(path);
  }
  if (options.trace == "-") {
    throw std::invalid_argument(
        "--trace - : expected a file, a history trace is no text");
  }
  dynamics::Lift input =
      dynamics::PumaLift(options.num_chains, options.rotor_inertia);
  const int steps = integrators::CountSteps(input.duration, options.step);
  integrators::CheckNumSteps(method, steps);
  constexpr int kFewestSteps = 5;  // a torque table between whose times to
                                   // interpolate
  if (steps < kFewestSteps) {
    throw std::invalid_argument(fmt::format(
        "{} steps: the lift is planned in at least {}", steps, kFewestSteps));
  }
  const BreakdownOptions breakdown_options = {
      .figure = options.figure,
      .partition = options.partition,
      .most_blocks = steps / method.block_size + 1,
      .repetitions = options.repetitions};
  if (options.breakdown) PrepareBreakdown(breakdown_options);
  const LiftCase lift(std::move(input), steps);
  const dynamics::ClosedChainSystem system(lift.lift().model, lift.torques(),
                                           options.lanes);
  integrators::IntegrationOptions integration_options = {
      .method = method,
      .step = lift.step(),
      .num_steps = steps,
      .figure = options.figure,
      .partition = options.partition,
      .wait = options.wait,
      .record = !options.output.empty()};
  if (options.breakdown) {
    integration_options.on_begin = &RecordBegin;
    integration_options.on_end = &RecordEnd;
  }
  integrators::Integration integration(system, integration_options);
  if (!options.trace.empty()) {
    macrotask::SetTraceClasses(macrotask::kAllTraceClasses);
  }
  const auto run = [&] {
    return options.start == StartKind::kPlan
               ? integration.RunFrom(lift.Planned())
               : integration.Run(lift.InitialState());
  };
  const auto result = run();
  const macrotask::Trace trace = macrotask::TakeTrace();
  macrotask::SetTraceClasses(0);
  std::string report = Report(options, lift, system, result);
  if (!options.trace.empty()) report += WriteHistory(trace, options.trace);
  if (options.breakdown) {
    report += "\n" + BreakdownText(MeasureBreakdown(run, breakdown_options));
  }
  if (!options.output.empty()) {
    WriteOutput(options.output,
                TrajectoryCsv(system, integration, lift.step()));
    if (options.output == "-") report.clear();
  }
  return report;
}

}  // namespace bench
