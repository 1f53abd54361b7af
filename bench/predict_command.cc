#include "bench/predict_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <utility>

#include "bench/command_options.h"
#include "bench/output_file.h"
#include "bench/predict/block_calibration.h"
#include "bench/predict/calibration.h"
#include "bench/predict/figure_program.h"
#include "bench/predict/machine_file.h"
#include "bench/predict/prediction_table.h"
#include "bench/predict/trace_prediction.h"
#include "bench/predict/trace_program.h"
#include "bench/predict/tuning.h"
#include "bench/predict/validation.h"
#include "bench/progress.h"

namespace bench {
namespace {

// A machine of a million processors would take hours.
constexpr int kMostProcessors = 4096;

void AddMethods(CLI::App* app, std::vector<std::string>* methods) {
  app->add_option("--method", *methods,
                  "B1PC5, B2PC5, B4PC5, or other B<points>PC<order>")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->capture_default_str();
}

CLI::Option* AddHoldTime(CLI::App* app, int* hold_time_us) {
  return app
      ->add_option("--hold-time", *hold_time_us,
                   "Hold time in microseconds, when waiting is measured")
      ->check(CLI::Range(0, 1'000'000))
      ->capture_default_str();
}

// B1PC5, against which S_a is, comes along where it is not wanted.
std::vector<integrators::BlockMethod> MethodsOf(
    const std::vector<std::string>& names) {
  std::vector<integrators::BlockMethod> methods;
  for (const std::string& name : names) {
    methods.push_back(integrators::ParseBlockMethod(name));
  }
  const bool has_baseline =
      std::any_of(methods.begin(), methods.end(),
                  [](const auto& method) { return method.name() == "B1PC5"; });
  if (!has_baseline) methods.push_back(integrators::B1PC5());
  return methods;
}

predict::CalibrationOptions CalibrationWith(int hold_time_us) {
  predict::CalibrationOptions options;
  options.hold_time = std::chrono::microseconds(hold_time_us);
  return options;
}

std::string MachineHeader(const predict::MachineModel& machine) {
  std::string text = fmt::format("machine:    {}, {} processors\n",
                                 machine.name, machine.processors);
  if (!machine.source.empty()) {
    text += fmt::format("source:     {}\n", machine.source);
  }
  for (const predict::Slowdown& slowdown : machine.slowdowns) {
    text += fmt::format(
        "slowdown:   computing takes {:.3f} times as long on {} processors or "
        "more{}{}\n",
        slowdown.factor, slowdown.from_processors,
        slowdown.lanes == 0 ? ""
                            : fmt::format(", {} lane{}", slowdown.lanes,
                                          slowdown.lanes == 1 ? "" : "s"),
        slowdown.why.empty() ? "" : ": " + slowdown.why);
  }
  for (const predict::Condition& condition : machine.conditions) {
    if (condition.name.empty()) continue;
    text += fmt::format("condition:  {}, {:.0f} % of the time\n",
                        condition.name, 100 * condition.share);
  }
  return text + "\n";
}

}  // namespace

void PredictCommand::Add(CLI::App* app) {
  app->add_option("--processors", processors_, "Numbers of processors")
      ->delimiter(',')
      ->check(CLI::Range(1, kMostProcessors))
      ->allow_extra_args(false)
      ->capture_default_str();
  AddMethods(app, &methods_);
  app->add_option("--chains", num_chains_, "PUMA 560 arms around the load")
      ->check(CLI::Range(1, kMostProcessors))
      ->capture_default_str();
  app->add_option("--lanes", lanes_,
                  "Chains and points in a vector register, 1 or 4 (default: "
                  "the most that the machine has)")
      ->check(CLI::IsMember({1, 4}));
  AddChoice<macrotask::WaitKind>(
      app, "--wait", &wait_,
      ByName({macrotask::WaitKind::kAuto, macrotask::WaitKind::kBlock,
              macrotask::WaitKind::kSpin, macrotask::WaitKind::kHold,
              macrotask::WaitKind::kLogical}),
      "How a task waits; auto (the default) is hold, and logical with more "
      "tasks than processors; of --trace always hold");
  AddHoldTime(app, &hold_time_us_);
  app->add_option("--work", work_us_,
                  "Busy work added to OCD of each chain at each point, in "
                  "microseconds")
      ->check(CLI::Range(0.0, 1e6))
      ->capture_default_str();
  app->add_option("--seed", seed_, "Of what is drawn")
      ->check(CLI::Range(0, 1'000'000'000))
      ->capture_default_str();
  app->add_option("--replications", replications_,
                  "How often every run is simulated")
      ->check(CLI::Range(1, 10'000))
      ->capture_default_str();
  AddOutputs(app);
}

void PredictCommand::AddOutputs(CLI::App* app) {
  auto* const machine = AddFile(
      app, "--machine", &machine_,
      "The machine, a file as --write-machine makes it or "
      "bench/machines/cray-ymp8-864.json (default: this machine, measured)");
  app->add_flag("--dedicated", dedicated_,
                "Without the machine's slowdowns, such as other users");
  AddFile(app, "--write-machine", &write_machine_,
          "Measure this machine and write what was found to this file (- for "
          "the standard output)")
      ->excludes(machine);
  auto* const trace =
      AddFile(app, "--trace", &trace_,
              "Predict the program that left this history trace, instead of "
              "the lift");
  AddChoice<predict::TaskPlacement>(
      app, "--placement", &placement_,
      {{"free", predict::TaskPlacement::kFree},
       {"pinned", predict::TaskPlacement::kPinned}},
      "Whether the tasks of --trace run wherever there is a processor (the "
      "default) or neighbours together, as those of RunTasks()");
  auto* const validate = app->add_flag(
      "--validate", validate_,
      "Predict all runs that this machine can measure, measure them, and "
      "compare; with --machine, compare with the paper instead");
  validate->excludes(trace);
  app->add_option("--rounds", rounds_,
                  "Of --validate: how often everything is measured, in turn")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  AddFile(app, "--csv", &csv_,
          "Write the rows to this file as CSV (- for the standard output, "
          "instead of the tables)");
}

void PredictCommand::CheckOutputs() const {
  for (const std::string& path : {csv_, write_machine_}) {
    if (!path.empty()) CheckOutput(path);
  }
  if (!csv_.empty() && csv_ == write_machine_) {
    throw std::invalid_argument("--csv and --write-machine both write to '" +
                                csv_ + "'");
  }
  if (!csv_.empty() && !trace_.empty()) {
    throw std::invalid_argument("--trace prints a table: expected no --csv");
  }
}

predict::MachineModel PredictCommand::GetMachine() const {
  predict::MachineModel machine;
  const int most_tasks =
      *std::max_element(processors_.begin(), processors_.end());
  if (machine_.empty()) {
    Progress progress;
    predict::CalibrationOptions options = CalibrationWith(hold_time_us_);
    options.most_tasks = std::max(options.most_tasks, most_tasks);
    machine = predict::Calibrate(options, [&](int done, int all) {
      progress.Show("calibrate", done, all);
    });
  } else {
    machine = predict::ReadMachine(machine_);
    predict::PrepareTrace(most_tasks);
  }
  if (!write_machine_.empty()) {
    WriteOutput(write_machine_, predict::MachineText(machine));
  }
  if (dedicated_) machine.slowdowns.clear();
  return machine;
}

std::string PredictCommand::Table(const predict::MachineModel& machine) const {
  predict::TableOptions options;
  options.processors = processors_;
  options.num_chains = num_chains_;
  options.num_lanes = lanes_ != 0 ? lanes_ : machine.widest_lanes();
  options.wait = wait_;
  options.work = work_us_ * 1e-6;
  machine.BlocksOf(options.num_lanes);
  Progress progress;
  const auto sweeps = SweepMethods(
      MethodsOf(methods_), [&] { return dynamics::PumaLift(num_chains_); },
      [&](const char* what, int done, int all) {
        progress.Show(what, done, all);
      });
  predict::PredictorOptions predictor_options;
  predictor_options.replications = replications_;
  predictor_options.seed = static_cast<std::uint64_t>(seed_);
  predict::Predictor predictor(machine, predictor_options);
  const auto rows = predict::PredictRows(options, sweeps, &predictor);
  if (!csv_.empty()) WriteOutput(csv_, predict::TableCsv(rows));
  const std::string lanes = fmt::format(
      "Predicted: the lift of {} arms to an error of 1e-6 m, {} lane{}, "
      "{}.\n\n",
      num_chains_, options.num_lanes, options.num_lanes == 1 ? "" : "s",
      macrotask::Name(wait_));
  return MachineHeader(machine) + lanes +
         (validate_ ? predict::PaperText(rows) : predict::TableText(rows));
}

std::string PredictCommand::OfTrace(
    const predict::MachineModel& machine) const {
  const TraceHistory history = MakeHistory(macrotask::ReadTrace(trace_));
  // Records were written as here, unless it was another machine.
  const double record = machine_.empty() ? predict::MeasureRecord() : 0;
  const predict::Program program = predict::ProgramOf(history, trace_, record);
  predict::PredictorOptions options;
  options.replications = replications_;
  options.seed = static_cast<std::uint64_t>(seed_);
  predict::Predictor predictor(machine, options);
  const auto wait =
      wait_ == macrotask::WaitKind::kAuto ? macrotask::WaitKind::kHold : wait_;
  const auto rows =
      predict::PredictTrace(program, processors_, wait, placement_, &predictor);
  return MachineHeader(machine) +
         predict::TracePredictionText(
             program, history.UsOf(history.end - history.begin) * 1e-6, rows);
}

void PredictCommand::Validate() const {
  Progress progress;
  const predict::Validation validation = predict::Validate(
      CalibrationWith(hold_time_us_), rounds_,
      [&](int done, int all) { progress.Show("validate", done, all); });
  if (!write_machine_.empty()) {
    WriteOutput(write_machine_, predict::MachineText(validation.machine));
  }
  if (!csv_.empty()) WriteOutput(csv_, predict::ValidationCsv(validation));
  if (csv_ == "-") return;
  WriteOutput("-", MachineHeader(validation.machine) +
                       predict::ValidationText(validation));
}

void PredictCommand::Run() const {
  CheckOutputs();
  MethodsOf(methods_);
  if (validate_ && machine_.empty()) return Validate();
  // What is wrong with it shows before anything is measured.
  if (!trace_.empty()) {
    predict::ProgramOf(MakeHistory(macrotask::ReadTrace(trace_)), trace_, 0);
  }
  const predict::MachineModel machine = GetMachine();
  const std::string text = trace_.empty() ? Table(machine) : OfTrace(machine);
  if (csv_ != "-" && write_machine_ != "-") WriteOutput("-", text);
}

void TuneCommand::Add(CLI::App* app) {
  AddMethods(app, &methods_);
  AddHoldTime(app, &hold_time_us_);
  app->add_option("--repetitions", repetitions_,
                  "How often the best are measured, in turn")
      ->check(CLI::Range(1, 100'000))
      ->capture_default_str();
  AddFile(app, "--write", &write_,
          "Write the winner to this file, as options of macrotask simulate "
          "(- for the standard output, instead of the report)");
}

void TuneCommand::Run() const {
  if (!write_.empty()) CheckOutput(write_);
  Progress progress;
  const predict::Tuning tuning =
      predict::Tune({.methods = MethodsOf(methods_),
                     .calibration = CalibrationWith(hold_time_us_),
                     .repetitions = repetitions_},
                    [&](const char* what, int done, int all) {
                      progress.Show(what, done, all);
                    });
  if (!write_.empty()) {
    WriteOutput(write_,
                predict::SimulateOptionsText(predict::WinnerOf(tuning)));
  }
  if (write_ != "-") WriteOutput("-", predict::TuningText(tuning));
}

}  // namespace bench
