#include "bench/sync_command.h"

#include <chrono>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "bench/command_options.h"
#include "bench/output_file.h"
#include "bench/progress.h"
#include "bench/sync_hold_time.h"
#include "bench/sync_report.h"
#include "macrotask/placement.h"

namespace bench {
namespace {

template <typename Value>
std::map<std::string, Value> ByNames(const std::vector<Value>& values) {
  std::map<std::string, Value> named;
  for (const Value value : values) named.emplace(Name(value), value);
  return named;
}

// An option of one or more values with names, "block,spin".
template <typename Value>
void AddList(CLI::App* app, const std::string& name, std::vector<Value>* values,
             const std::vector<Value>& all, const std::string& help) {
  const auto choices = ByNames(all);
  app->add_option_function<std::string>(
         name,
         [=](const std::string& text) {
           values->clear();
           std::istringstream words(text);
           for (std::string word; std::getline(words, word, ',');) {
             values->push_back(ChoiceOf(name, word, choices));
           }
           if (values->empty()) {
             throw std::invalid_argument(name + ": expected some of " +
                                         NamesOf(choices));
           }
         },
         help)
      ->option_text("(" + NamesOf(choices) + ") ,...");
}

void AddAxes(CLI::App* app, SyncAxes* axes) {
  constexpr int kMostTasks = 64;
  constexpr double kMostWork = 1000;
  AddList(app, "--constructs", &axes->families,
          {SyncFamily::kBarrier, SyncFamily::kEvent, SyncFamily::kLock,
           SyncFamily::kTask, SyncFamily::kLimit},
          "What to measure (default: everything)");
  app->add_option("--tasks", axes->num_tasks, "Numbers of tasks")
      ->delimiter(',')
      ->check(CLI::Range(1, kMostTasks))
      ->allow_extra_args(false)
      ->capture_default_str();
  AddList(app, "--wait", &axes->waits, AllWaitKinds(),
          "How the library's tasks wait (default: all ways)");
  app->add_option("--work", axes->works,
                  "Busy work of each task between two calls, in microseconds")
      ->delimiter(',')
      ->check(CLI::Range(0.0, kMostWork))
      ->allow_extra_args(false)
      ->capture_default_str();
  AddList(app, "--skew", &axes->skews, {Skew::kZero, Skew::kLate},
          "Whether all tasks come at once (zero, the default) or one comes 10 "
          "us late");
  AddChoice<SyncPlacement>(
      app, "--placement", &axes->placement,
      ByNames<SyncPlacement>({SyncPlacement::kPinned, SyncPlacement::kFree}),
      "Whether tasks are pinned as RunTasks() does (the default)");
}

SyncResult NewResult(const SyncAxes& axes, int repetitions) {
  SyncResult result = {.machine = DescribeMachine(),
                       .axes = axes,
                       .repetitions = repetitions,
                       .clocks = {},
                       .round_trips = {},
                       .rows = {},
                       .break_even = {}};
  if (macrotask::NumProcessors() >= 2) result.clocks = CompareClocks();
  return result;
}

void MeasureConstructs(SyncResult* result) {
  Progress progress;
  const std::vector<SyncSeries> series = SampleAll(
      PlanVariants(result->axes), {.repetitions = result->repetitions},
      [&](int done, int all) { progress.Show("sync", done, all); });
  result->split = SplitOf(series);
  for (const SyncSeries& one : series) {
    for (const SyncSample& sample : one.samples) {
      const double trip = sample.conditions.after.round_trip;
      if (trip > 0) result->round_trips.push_back(trip);
    }
  }
  result->rows = MakeRows(series, result->split);
}

}  // namespace

void SyncCommand::Add(CLI::App* app) {
  AddAxes(app, &axes_);
  app->add_option("--hold-time", hold_time_us_, "Hold time in microseconds")
      ->check(CLI::Range(0, 1'000'000))
      ->capture_default_str();
  app->add_option("--repetitions", repetitions_,
                  "How often everything is sampled, in turn")
      ->check(CLI::Range(1, 10'000))
      ->capture_default_str();
  app->add_flag("--break-even", break_even_,
                "How small the work between two barriers of two tasks may be, "
                "instead of the tables; of the axes only --wait, --hold-time "
                "and --placement count");
  auto* const calibrate = app->add_flag(
      "--calibrate", calibrate_,
      "How long a wait should spin before it sleeps, instead of the tables; of "
      "the other options only --repetitions counts");
  calibrate->excludes(app->get_option("--break-even"));
  AddFile(app, "--csv", &csv_,
          "Write the rows to this file as CSV (- for the standard output, "
          "instead of the tables)");
  AddFile(app, "--json", &json_,
          "Write them to this file as JSON in the layout of Google Benchmark "
          "(- likewise)");
}

void SyncCommand::CheckOutputs() const {
  for (const std::string& path : {csv_, json_}) {
    if (!path.empty()) CheckOutput(path);
  }
  if (!csv_.empty() && csv_ == json_) {
    throw std::invalid_argument("--csv and --json both write to '" + csv_ +
                                "'");
  }
}

void SyncCommand::Calibrate() const {
  if (!csv_.empty() || !json_.empty()) {
    throw std::invalid_argument(
        "--calibrate prints one figure: expected no --csv and no --json");
  }
  Progress progress;
  const HandOverSamples samples = MeasureHandOvers(
      repetitions_,
      [&](int done, int all) { progress.Show("calibrate", done, all); });
  WriteOutput("-", HoldTimeText(CalcHoldTime(samples)));
}

void SyncCommand::Run() const {
  if (calibrate_) return Calibrate();
  CheckOutputs();
  SyncAxes axes = axes_;
  axes.hold_time = std::chrono::microseconds(hold_time_us_);
  SyncResult result = NewResult(axes, repetitions_);
  if (break_even_) {
    Progress progress;
    result.break_even = MeasureBreakEven(
        axes, repetitions_,
        [&](int done, int all) { progress.Show("break-even", done, all); });
    result.round_trips = result.break_even->round_trips;
  } else {
    MeasureConstructs(&result);
  }
  if (csv_ != "-" && json_ != "-") WriteOutput("-", SyncText(result));
  if (!csv_.empty()) WriteOutput(csv_, SyncCsv(result));
  if (!json_.empty()) WriteOutput(json_, SyncJson(result));
}

}  // namespace bench
