#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstddef>

#include "bench/gains.h"
#include "bench/predict/tuning.h"
#include "bench/sync_report.h"
#include "bench/text_table.h"

namespace bench::predict {
namespace {

std::string Micro(double seconds) {
  return fmt::format("{:.1f}", seconds * 1e6);
}

std::string WaitText(const RunCase& run_case) {
  return run_case.figure.partition.num_tasks() == 1
             ? "-"
             : std::string(macrotask::Name(run_case.wait));
}

std::vector<std::string> CaseCells(const Candidate& candidate) {
  const RunCase& run_case = candidate.run_case;
  return {run_case.figure.method.name(),
          fmt::format("{}", run_case.figure.partition.chain_tasks),
          fmt::format("{}", run_case.figure.partition.integration_tasks),
          fmt::format("{}", run_case.num_lanes), WaitText(run_case)};
}

const Candidate& SerialOf(const Tuning& tuning) {
  return *std::find_if(tuning.measured.begin(), tuning.measured.end(),
                       [](const auto& one) {
                         return one.run_case.figure.partition.num_tasks() == 1;
                       });
}

std::string MeasuredTable(const Tuning& tuning) {
  TextTable table({"method", "m^", "p^", "lanes", "wait", "predicted T (us)",
                   "measured T (us)", "times the serial one"});
  const Candidate& serial = SerialOf(tuning);
  for (const Candidate& candidate : tuning.measured) {
    std::vector<std::string> cells = CaseCells(candidate);
    const Interval interval = MedianInterval(candidate.measured);
    const Gain gain = GainOf(serial.measured, candidate.measured);
    cells.push_back(Micro(candidate.predicted));
    cells.push_back(fmt::format("{} [{}, {}]",
                                Micro(Median(candidate.measured)),
                                Micro(interval.low), Micro(interval.high)));
    cells.push_back(fmt::format("{:.2f} [{:.2f}, {:.2f}]", gain.value,
                                gain.interval.low, gain.interval.high));
    table.AddRow(std::move(cells));
  }
  return table.Markdown();
}

std::string WinnerSentence(const Tuning& tuning) {
  const Candidate& winner = WinnerOf(tuning);
  const Candidate& serial = SerialOf(tuning);
  if (&winner == &serial) {
    return "The serial program wins.\n";
  }
  const Gain gain = GainOf(serial.measured, winner.measured);
  return fmt::format(
      "{} with m^ = {}, p^ = {}, {} lanes, {} wins: {:.2f} times as fast as "
      "the best serial\nprogram [{:.2f}, {:.2f}].\n",
      winner.run_case.figure.method.name(),
      winner.run_case.figure.partition.chain_tasks,
      winner.run_case.figure.partition.integration_tasks,
      winner.run_case.num_lanes, macrotask::Name(winner.run_case.wait),
      gain.value, gain.interval.low, gain.interval.high);
}

std::string TurnSentence(const RuleTurn& turn) {
  std::string text =
      fmt::format("{} lane{}: the rule takes {}, ", turn.num_lanes,
                  turn.num_lanes == 1 ? "" : "s", turn.rule);
  if (turn.work && *turn.work == 0) {
    return text + fmt::format(
                      "rightly: {} of computing between two barriers, which "
                      "cost {}, a ratio\n  of {:.1f}.\n",
                      DurationText(turn.compute), DurationText(turn.sync),
                      turn.compute / turn.sync);
  }
  text += fmt::format("{:.2f} times the time of the best, {}. ", turn.loss,
                      turn.best);
  if (!turn.work) {
    return text + fmt::format(
                      "Even {} of further\n  work for each chain at "
                      "each point does not change that.\n",
                      DurationText(kMostWork));
  }
  return text + fmt::format(
                    "It is\n  right from {} of further work for each chain at "
                    "each point on: then a task computes {}\n  between two "
                    "barriers, which cost {}, a ratio of {:.1f}.\n",
                    DurationText(*turn.work), DurationText(turn.compute),
                    DurationText(turn.sync), turn.compute / turn.sync);
}

std::string ToText(double x) {
  char text[32];
  const auto result = std::to_chars(text, text + sizeof text, x);
  return std::string(text, result.ptr);
}

}  // namespace

std::string SimulateOptionsText(const Candidate& candidate) {
  const RunCase& run_case = candidate.run_case;
  return fmt::format(
      "--method {} --step {} --figure {} --chain-tasks {} "
      "--integration-tasks {} --lanes {} --wait {}\n",
      run_case.figure.method.name(), ToText(1.0 / run_case.figure.num_steps),
      integrators::Name(run_case.figure.figure),
      run_case.figure.partition.chain_tasks,
      run_case.figure.partition.integration_tasks, run_case.num_lanes,
      macrotask::Name(run_case.wait));
}

std::string TuningText(const Tuning& tuning) {
  std::string text = fmt::format(
      "The lift to an error of 1e-6 m on {}, {} processors: the best three of "
      "{} ways\npredicted and the best serial one, measured in turn.\n\n{}\n{}"
      "\nAs options of macrotask simulate:\n\n{}\n"
      "The paper's rule: most spatial parallelism, then the most accurate "
      "method.\n\n",
      tuning.machine.name, tuning.machine.processors, tuning.candidates.size(),
      MeasuredTable(tuning), WinnerSentence(tuning),
      SimulateOptionsText(WinnerOf(tuning)));
  for (const RuleTurn& turn : tuning.turns) text += "- " + TurnSentence(turn);
  return text;
}

}  // namespace bench::predict
