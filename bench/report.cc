#include "bench/report.h"

#include <fmt/format.h>

#include <chrono>
#include <iterator>
#include <utility>

#include "bench/gains.h"
#include "bench/text_table.h"

namespace bench {
namespace {

std::string LanesText(const LaneTables& tables) {
  return tables.lanes == dynamics::Lanes::kOne ? "1 lane" : "4 lanes";
}

std::string Micro(double seconds) {
  return fmt::format("{:.1f}", seconds * 1e6);
}

std::string MicroWithInterval(const std::vector<double>& seconds) {
  const Interval interval = MedianInterval(seconds);
  return fmt::format("{:.1f} [{:.1f}, {:.1f}]", Median(seconds) * 1e6,
                     interval.low * 1e6, interval.high * 1e6);
}

std::string NanoWithInterval(const std::vector<double>& seconds) {
  const Interval interval = MedianInterval(seconds);
  return fmt::format("{:.0f} [{:.0f}, {:.0f}]", Median(seconds) * 1e9,
                     interval.low * 1e9, interval.high * 1e9);
}

std::string PaperCell(const TableRow& row, double PaperRow::*figure) {
  return row.paper == nullptr ? "" : fmt::format("{:.4g}", row.paper->*figure);
}

std::string MachineText(const Reproduction& r) {
  return fmt::format(
      "macrotask {} ({})\n"
      "processor:  {}, {} usable\n"
      "kernel:     {}\n"
      "compiler:   {}, {}\n"
      "placement:  {}\n"
      "waiting:    {}, hold time {} us\n",
      r.machine.version, r.machine.git_hash, r.machine.cpu,
      r.machine.processors, r.machine.kernel, r.machine.compiler,
      r.machine.flags, r.placement, Name(r.wait.kind),
      std::chrono::duration_cast<std::chrono::microseconds>(r.wait.hold_time)
          .count());
}

std::string SweepText(const Reproduction& r) {
  TextTable table(
      {"method", "steps for 1e-6 m", "observed order", "S_a", "S_a (paper)"});
  for (const MethodSweep& sweep : r.sweeps) {
    const int b = sweep.method.block_size;
    double paper = 1;
    for (const PaperRow& row : kPaperTable2) {
      if (row.block_size == b) paper = row.S_a;
    }
    table.AddRow({sweep.method.name(),
                  fmt::format("{:.1f}", sweep.steps_at_target),
                  fmt::format("{:.1f}", -sweep.fit.slope),
                  fmt::format("{:.3f}", StepSpeedup(r, b)),
                  fmt::format("{:.3g}", paper)});
  }
  return "Accuracy: error of the final position over the number of steps, "
         "log-log regression,\nstarted from the plan. S_a from the numbers of "
         "steps: no clock.\n\n" +
         table.Markdown();
}

std::vector<std::string> PartitionCells(const TableRow& row) {
  return {fmt::format("{}", row.processors()),
          fmt::format("{}", row.partition.chain_tasks),
          fmt::format("{}", row.partition.integration_tasks)};
}

std::string NeedsText(const TableRow& row) {
  return fmt::format("needs {} processors", row.processors());
}

// What is predicted stands in columns of its own.
std::vector<std::string> PredictedCells(const TableRow& row, bool with_S_T) {
  if (!row.predicted) {
    return std::vector<std::string>(with_S_T ? 3 : 2);
  }
  const predict::PredictedRow& predicted = *row.predicted;
  const auto text = [](const predict::Ranged& value, double factor,
                       int digits) {
    return fmt::format("{:.{}f} [{:.{}f}, {:.{}f}]", value.value * factor,
                       digits, value.range.low * factor, digits,
                       value.range.high * factor, digits);
  };
  std::vector<std::string> cells = {text(predicted.T, 1e6, 1),
                                    text(predicted.S_p, 1, 2)};
  if (with_S_T) cells.push_back(text(predicted.S_T, 1, 2));
  return cells;
}

void Append(std::vector<std::string> more, std::vector<std::string>* cells) {
  cells->insert(cells->end(), std::make_move_iterator(more.begin()),
                std::make_move_iterator(more.end()));
}

std::string SpeedupText(const LaneTables& tables, const TableRow& row) {
  const Gain s = SpeedupOf(SerialRow(tables, row.block_size), row);
  if (row.processors() == 1) return "1.00";
  return fmt::format("{:.2f} [{:.2f}, {:.2f}]", s.value, s.interval.low,
                     s.interval.high);
}

std::string BitsText(const TableRow& row) {
  return row.same_bits ? "same" : "DIFFERENT";
}

std::string Table1Text(const LaneTables& tables) {
  TextTable table({"processors", "m^", "p^", "T (us)", "S_p", "states",
                   "predicted T (us)", "S_p", "paper T (s)", "S_p"});
  for (const TableRow& row : tables.rows) {
    if (row.block_size != 4) continue;
    std::vector<std::string> cells = PartitionCells(row);
    cells.push_back(row.measured() ? MicroWithInterval(T(row))
                                   : NeedsText(row));
    cells.push_back(row.measured() ? SpeedupText(tables, row) : "");
    cells.push_back(BitsText(row));
    Append(PredictedCells(row, false), &cells);
    cells.push_back(PaperCell(row, &PaperRow::T));
    cells.push_back(PaperCell(row, &PaperRow::S_p));
    table.AddRow(std::move(cells));
  }
  return fmt::format("Table 1: speedup results for B4PC5, {}.\n\n{}",
                     LanesText(tables), table.Markdown());
}

std::string Table2Text(const Reproduction& r, const LaneTables& tables) {
  TextTable table({"processors", "m^", "p^", "block", "T (us)", "S_p",
                   "S_a steps", "S_a clock", "S_T", "states",
                   "predicted T (us)", "S_p", "S_T", "paper T (s)", "S_p",
                   "S_a", "S_T"});
  for (const TableRow& row : tables.rows) {
    std::vector<std::string> cells = PartitionCells(row);
    cells.push_back(fmt::format("{}", row.block_size));
    if (row.measured()) {
      const double S_a = ClockSpeedup(tables, row.block_size);
      const double S_p =
          SpeedupOf(SerialRow(tables, row.block_size), row).value;
      cells.push_back(Micro(MedianT(row)));
      cells.push_back(fmt::format("{:.2f}", S_p));
      cells.push_back(fmt::format("{:.3f}", StepSpeedup(r, row.block_size)));
      cells.push_back(fmt::format("{:.3f}", S_a));
      cells.push_back(fmt::format("{:.2f}", S_p * S_a));
    } else {
      cells.insert(cells.end(), {NeedsText(row), "", "", "", ""});
    }
    cells.push_back(BitsText(row));
    Append(PredictedCells(row, true), &cells);
    cells.push_back(PaperCell(row, &PaperRow::T));
    cells.push_back(PaperCell(row, &PaperRow::S_p));
    cells.push_back(PaperCell(row, &PaperRow::S_a));
    cells.push_back(PaperCell(row, &PaperRow::S_T));
    table.AddRow(std::move(cells));
  }
  return fmt::format(
      "Table 2: accuracy performance for various configurations, {}.\n\n{}",
      LanesText(tables), table.Markdown());
}

std::string LiftText(const LaneTables& tables) {
  const LiftRun& lift = tables.lift;
  return fmt::format(
      "The one-second lift, B1PC5, one processor, {}, DOPRI5 start "
      "included: {} us,\n{} steps, error {:.2g} m, {:.0f} times faster than "
      "real time.\n",
      LanesText(tables), MicroWithInterval(lift.seconds), lift.steps,
      lift.error, 1 / Median(lift.seconds));
}

// What two tasks gain that never wait for each other.
std::string CeilingText(const Reproduction& r) {
  std::string text;
  for (const Cost& one : r.costs) {
    for (const Cost& two : r.costs) {
      if (one.name != "evaluation" || two.with != one.with ||
          two.name != "evaluation, two at once") {
        continue;
      }
      const Gain half = GainOf(one.seconds, two.seconds);
      text += fmt::format(
          "Two tasks that never wait for each other gain {:.2f} [{:.2f}, "
          "{:.2f}] on this machine ({}).\n",
          2 * half.value, 2 * half.interval.low, 2 * half.interval.high,
          one.with);
    }
  }
  return text;
}

std::string CostText(const Reproduction& r) {
  TextTable table({"what", "with", "ns [95 % interval]"});
  for (const Cost& cost : r.costs) {
    table.AddRow({cost.name, cost.with, NanoWithInterval(cost.seconds)});
  }
  return "What a call costs (all chains at one point; synchronization without "
         "work between).\n\n" +
         table.Markdown() + "\n" + CeilingText(r);
}

}  // namespace

std::string ReportText(const Reproduction& r) {
  std::string text = MachineText(r) + "\n" + SweepText(r);
  for (const LaneTables& tables : r.lanes) {
    text += "\n" + Table1Text(tables) + "\n" + Table2Text(r, tables);
  }
  text +=
      "\nT: median over the repetitions (interleaved), at the steps for 1e-6 "
      "m; brackets: 95 %\nintervals. S_p, S_a clock: medians of the ratios of "
      "runs next to each other.\nstates: bit for bit those of the serial "
      "program, or not. predicted: by simulation, with\nthe costs of this "
      "machine, as if it had so many processors; brackets: the middle 95 %\n"
      "of the replications (macrotask predict). Paper: CRAY Y-MP8/864.\n\n";
  for (const LaneTables& tables : r.lanes) text += LiftText(tables);
  return text + "\n" + CostText(r);
}

}  // namespace bench
