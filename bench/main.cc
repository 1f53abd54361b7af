#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <exception>
#include <stdexcept>
#include <string>

#include "bench/build_info.h"
#include "bench/command_options.h"
#include "bench/output_file.h"
#include "bench/predict_command.h"
#include "bench/report.h"
#include "bench/reproduce.h"
#include "bench/simulate.h"
#include "bench/sync_command.h"
#include "bench/trace_command.h"

namespace bench {
namespace {

constexpr int kBadInput = 2;

// Options that several subcommands have.
struct WaitOptions {
  macrotask::WaitKind kind = macrotask::WaitKind::kAuto;
  int hold_time_us = 50;

  macrotask::WaitPolicy Policy() const {
    return {.kind = kind, .hold_time = std::chrono::microseconds(hold_time_us)};
  }
};

void AddWaitOptions(CLI::App* app, WaitOptions* wait) {
  AddChoice<macrotask::WaitKind>(
      app, "--wait", &wait->kind,
      ByName({macrotask::WaitKind::kAuto, macrotask::WaitKind::kBlock,
              macrotask::WaitKind::kSpin, macrotask::WaitKind::kHold,
              macrotask::WaitKind::kLogical}),
      "How a task waits: block sleeps (pthread barriers, condition variables), "
      "spin asks again and again, hold spins for the hold time, then sleeps, "
      "logical gives its turn to the next task of its processor, in user "
      "space; auto (the default) is hold, and logical with more tasks than "
      "processors");
  app->add_option("--hold-time", wait->hold_time_us,
                  "Hold time in microseconds")
      ->check(CLI::Range(0, 1'000'000))
      ->capture_default_str();
}

struct ReproduceCommand {
  WaitOptions wait;
  int repetitions = 200;
  std::string csv, json;

  void Add(CLI::App* app);
  void Run() const;
};

void ReproduceCommand::Add(CLI::App* app) {
  AddWaitOptions(app, &wait);
  app->add_option("--repetitions", repetitions,
                  "How often everything is timed, in turn")
      ->check(CLI::Range(1, 100'000))
      ->capture_default_str();
  AddFile(app, "--csv", &csv,
          "Write Table 2 to this file as CSV (- for the standard output, "
          "instead of the tables)");
  AddFile(app, "--json", &json,
          "Write everything, with every raw figure, to this file as JSON (- "
          "likewise)");
}

void ReproduceCommand::Run() const {
  for (const std::string& path : {csv, json}) {
    if (!path.empty()) CheckOutput(path);
  }
  if (!csv.empty() && csv == json) {
    throw std::invalid_argument("--csv and --json both write to '" + csv + "'");
  }
  const Reproduction result =
      Reproduce({.repetitions = repetitions, .wait = wait.Policy()});
  if (csv != "-" && json != "-") WriteOutput("-", ReportText(result));
  if (!csv.empty()) WriteOutput(csv, ReportCsv(result));
  if (!json.empty()) WriteOutput(json, ReportJson(result));
}

struct SimulateCommand {
  SimulateOptions options;
  WaitOptions wait;

  void Add(CLI::App* app);
  void Run();
};

void SimulateCommand::Add(CLI::App* app) {
  using integrators::Figure;
  app->add_option("--method", options.method,
                  "B1PC5, B2PC5, B4PC5, or another B<points>PC<order>")
      ->capture_default_str();
  app->add_option("--step", options.step,
                  "Time between grid points in seconds; must divide the one "
                  "second of the lift")
      ->capture_default_str();
  AddChoice<Figure>(app, "--figure", &options.figure,
                    ByName({Figure::kSerial, Figure::kFigure2, Figure::kFigure3,
                            Figure::kFigure7, Figure::kFigure8}),
                    "Task structure: one of the paper's figures, or the serial "
                    "program; figure8 (the default) can do all the others do");
  app->add_option("--chain-tasks", options.partition.chain_tasks,
                  "Tasks along the chains, m^")
      ->capture_default_str();
  app->add_option("--integration-tasks", options.partition.integration_tasks,
                  "Tasks along the points of a block, p^")
      ->capture_default_str();
  AddWaitOptions(app, &wait);
  AddChoice<dynamics::Lanes>(
      app, "--lanes", &options.lanes,
      {{"1", dynamics::Lanes::kOne}, {"4", dynamics::Lanes::kFour}},
      "Chains and points that one task computes at "
      "once in a vector register (4 is the default)");
  AddChoice<StartKind>(
      app, "--start", &options.start,
      {{"dopri5", StartKind::kDopri5}, {"plan", StartKind::kPlan}},
      "Where the first derivative values come from: computed "
      "(the default) or known from the plan");
  app->add_option("--chains", options.num_chains,
                  "PUMA 560 arms around the load")
      ->capture_default_str();
  app->add_flag("--rotor-inertia", options.rotor_inertia,
                "Add the motors' inertia G^2 Jm to the arms");
  AddFile(app, "--output", &options.output,
          "Write the trajectory to this file as CSV: load, joints, "
          "torques and tip forces at every grid point (- for the "
          "standard output, instead of the report)");
  AddFile(app, "--trace", &options.trace,
          "Record the history trace of the run in this file, for "
          "macrotask trace");
  CLI::Option* const breakdown = app->add_flag(
      "--breakdown", options.breakdown,
      "Run it again and again, and say for every task how much of the time it "
      "computed and how long it waited where");
  breakdown->excludes("--trace")->excludes("--output");
  app->add_option("--repetitions", options.repetitions,
                  "How often it is run for --breakdown, with and without a "
                  "history trace in turn")
      ->check(CLI::Range(1, 100'000))
      ->needs(breakdown)
      ->capture_default_str();
}

void SimulateCommand::Run() {
  options.wait = wait.Policy();
  const std::string report = Simulate(options);
  if (!report.empty()) WriteOutput("-", report);
}

int Main(int argc, char** argv) {
  CLI::App app{
      "Parallel dynamic simulation of robot arms that carry a load together,\n"
      "as McMillan, Sadayappan and Orin did on a CRAY Y-MP in 1993.\n"
      "\n"
      "  macrotask reproduce     their experiment, Tables 1 and 2\n"
      "  macrotask simulate      one run of it, as you like\n"
      "  macrotask trace         read a history trace\n"
      "  macrotask sync          what synchronization costs on this machine\n"
      "  macrotask predict       machines with other numbers of processors\n"
      "  macrotask tune          the fastest way to run it on this machine\n",
      "macrotask"};
  app.set_version_flag("--version",
                       fmt::format("macrotask {} ({})", kVersion, kGitHash));
  app.require_subcommand(1);

  ReproduceCommand reproduce;
  CLI::App* reproduce_app = app.add_subcommand(
      "reproduce",
      "Run the paper's experiment on this machine: the steps each method needs "
      "for an\nerror of 1e-6 m, then Tables 1 and 2 with the paper's figures "
      "beside ours");
  reproduce.Add(reproduce_app);

  SimulateCommand simulate;
  CLI::App* simulate_app = app.add_subcommand(
      "simulate",
      "Simulate the lift once: PUMA 560 arms raise a 4 kg load by 0.8 m in one "
      "second,\ndriven by a torque profile computed beforehand");
  simulate.Add(simulate_app);

  TraceCommand trace;
  CLI::App* trace_app = app.add_subcommand("trace", TraceCommand::kDescription);
  trace.Add(trace_app);

  SyncCommand sync;
  CLI::App* sync_app = app.add_subcommand("sync", SyncCommand::kDescription);
  sync.Add(sync_app);

  PredictCommand predict;
  CLI::App* predict_app =
      app.add_subcommand("predict", PredictCommand::kDescription);
  predict.Add(predict_app);

  TuneCommand tune;
  CLI::App* tune_app = app.add_subcommand("tune", TuneCommand::kDescription);
  tune.Add(tune_app);

  try {
    app.parse(argc, argv);
    if (reproduce_app->parsed()) reproduce.Run();
    if (simulate_app->parsed()) simulate.Run();
    if (trace_app->parsed()) trace.Run();
    if (sync_app->parsed()) sync.Run();
    if (predict_app->parsed()) predict.Run();
    if (tune_app->parsed()) tune.Run();
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);  // --help
    fmt::print(stderr, "macrotask: {}\n", error.what());
    return kBadInput;
  } catch (const std::exception& error) {
    fmt::print(stderr, "macrotask: {}\n", error.what());
    return kBadInput;
  }
  return 0;
}

}  // namespace
}  // namespace bench

int main(int argc, char** argv) { return bench::Main(argc, argv); }
