#include "bench/predict/trace_prediction.h"

#include <fmt/format.h>

#include "bench/text_table.h"

namespace bench::predict {
namespace {

std::string Percent(double share) { return fmt::format("{:.1f}", 100 * share); }

}  // namespace

std::vector<TracePrediction> PredictTrace(const Program& program,
                                          const std::vector<int>& processors,
                                          macrotask::WaitKind wait,
                                          TaskPlacement placement,
                                          Predictor* predictor) {
  std::vector<TracePrediction> rows;
  for (const int n : processors) {
    rows.push_back({n, predictor->PredictProgram(program, wait, n, placement)});
  }
  return rows;
}

std::string TracePredictionText(const Program& program, double measured,
                                const std::vector<TracePrediction>& rows) {
  constexpr double kMs = 1e3;
  const double work = Work(program);
  TextTable table({"processors", "T (ms)", "speedup", "critical path",
                   "work bound", "free sync", "compute %", "imbalance %",
                   "sync %", "queue %", "absent %"});
  for (const auto& [processors, prediction] : rows) {
    const Interval range = RangeOf(prediction.seconds);
    const double total = prediction.where.total();
    const Limits& limits = prediction.limits;
    table.AddRow({fmt::format("{}", processors),
                  fmt::format("{:.3f} [{:.3f}, {:.3f}]", prediction.T() * kMs,
                              range.low * kMs, range.high * kMs),
                  fmt::format("{:.2f}", work / prediction.T()),
                  fmt::format("{:.2f}", work / limits.critical_path),
                  fmt::format("{:.2f}", work / limits.work_bound),
                  fmt::format("{:.2f}", work / limits.free_sync),
                  Percent(prediction.where.compute / total),
                  Percent(prediction.where.imbalance / total),
                  Percent(prediction.where.sync / total),
                  Percent(prediction.where.queue / total),
                  Percent(prediction.where.absent / total)});
  }
  return fmt::format(
             "{} tasks compute {:.3f} ms in all; the trace took {:.3f} ms.\n\n",
             program.num_tasks(), work * kMs, measured * kMs) +
         table.Markdown() +
         "\nspeedup: all computing over T. Limits: with processors without "
         "end and free waiting\n(critical path), if nobody ever waited (work "
         "bound), on these processors with free\nwaiting (free sync). "
         "imbalance: until the last one came, or the post, or the release;\n"
         "sync: from then on; queue: others had the processor; absent: before "
         "a task's start\nand after its end. Times in which the system took a "
         "processor away count as computing.\n";
}

}  // namespace bench::predict
