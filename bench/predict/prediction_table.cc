#include "bench/predict/prediction_table.h"

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <tuple>
#include <utility>

namespace bench::predict {
namespace {

using integrators::Figure;
using integrators::Partition;

std::vector<int> DivisorsOf(int n) {
  std::vector<int> divisors;
  for (int d = 1; d <= n; ++d) {
    if (n % d == 0) divisors.push_back(d);
  }
  return divisors;
}

Ranged RangedOf(const std::vector<double>& values) {
  return {Median(values), RangeOf(values)};
}

std::vector<double> Times(const std::vector<double>& values, double factor) {
  std::vector<double> scaled = values;
  for (double& value : scaled) value *= factor;
  return scaled;
}

// The steps for the target error are no whole number; runs take one.
double ScaleOf(const MethodSweep& sweep) {
  return sweep.steps_at_target / WholeSteps(sweep);
}

const PaperRow* InPaper(Partition partition, int block_size, int num_values,
                        int num_chains) {
  if (num_chains != 4 || num_values != 5) return nullptr;
  for (const PaperRow& row : kPaperTable2) {
    if (row.chain_tasks == partition.chain_tasks &&
        row.integration_tasks == partition.integration_tasks &&
        row.block_size == block_size) {
      return &row;
    }
  }
  return nullptr;
}

// A method and its serial program.
struct Serial {
  const MethodSweep* sweep;
  std::vector<double> seconds;  // at the steps for the target error
};

PredictedRow MakeRow(const TableOptions& options, const Serial& serial,
                     const Serial& baseline, Partition partition,
                     int processors, Predictor* predictor) {
  const MethodSweep& sweep = *serial.sweep;
  const Prediction prediction =
      predictor->Predict(CaseOf(options, sweep, partition, processors));
  const double scale = ScaleOf(sweep);
  const std::vector<double> seconds = Times(prediction.seconds, scale);
  PredictedRow row;
  row.processors = processors;
  row.method = sweep.method;
  row.partition = partition;
  row.T = RangedOf(seconds);
  row.S_p = RangedOf(Ratios(serial.seconds, seconds));
  row.S_T = RangedOf(Ratios(baseline.seconds, seconds));
  row.S_a = Median(Ratios(baseline.seconds, serial.seconds));
  const double total = prediction.where.total();
  row.where = {.compute = prediction.where.compute / total,
               .imbalance = prediction.where.imbalance / total,
               .sync = prediction.where.sync / total,
               .queue = prediction.where.queue / total,
               .absent = prediction.where.absent / total};
  const double T_serial = Median(serial.seconds);
  const Limits& limits = prediction.limits;
  row.critical_path = T_serial / (limits.critical_path * scale);
  row.work_bound = T_serial / (limits.work_bound * scale);
  row.free_sync = T_serial / (limits.free_sync * scale);
  row.paper = InPaper(partition, sweep.method.block_size,
                      sweep.method.num_values, options.num_chains);
  // The paper's row is of as many processors as tasks.
  if (row.paper != nullptr && row.paper->processors != processors) {
    row.paper = nullptr;
  }
  return row;
}

}  // namespace

std::vector<Partition> UsefulPartitions(int processors, int num_chains,
                                        int block_size) {
  std::vector<Partition> useful;
  int most_spatial = 0;
  for (int p : DivisorsOf(block_size)) {
    int most = 0;
    for (const int m : DivisorsOf(num_chains)) {
      if (m * p <= processors) most = m;
    }
    if (most > 0) useful.push_back({most, p});
  }
  std::reverse(useful.begin(), useful.end());
  std::vector<Partition> best;
  for (const Partition& partition : useful) {
    // Those with more points come first: fewer points need more chains.
    if (partition.chain_tasks <= most_spatial) continue;
    most_spatial = partition.chain_tasks;
    best.push_back(partition);
  }
  return best;
}

RunCase CaseOf(const TableOptions& options, const MethodSweep& sweep,
               Partition partition, int processors) {
  const bool serial = partition.num_tasks() == 1;
  return {.figure = {.method = sweep.method,
                     .figure = serial ? Figure::kSerial : Figure::kFigure8,
                     .partition = partition,
                     .num_chains = options.num_chains,
                     .num_steps = WholeSteps(sweep)},
          .num_lanes = options.num_lanes,
          .wait = options.wait,
          .work = options.work,
          .processors = processors};
}

std::vector<PredictedRow> PredictRows(const TableOptions& options,
                                      const std::vector<MethodSweep>& sweeps,
                                      Predictor* predictor) {
  std::vector<Serial> serials;
  const Serial* baseline = nullptr;
  for (const MethodSweep& sweep : sweeps) {
    const Prediction serial =
        predictor->Predict(CaseOf(options, sweep, {1, 1}, 1));
    serials.push_back({&sweep, Times(serial.seconds, ScaleOf(sweep))});
  }
  for (const Serial& serial : serials) {
    if (serial.sweep->method.name() == "B1PC5") baseline = &serial;
  }
  if (baseline == nullptr) {
    throw std::invalid_argument("S_a and S_T are against B1PC5: expected it");
  }
  std::vector<PredictedRow> rows;
  for (const int processors : options.processors) {
    for (const Serial& serial : serials) {
      for (const Partition partition :
           UsefulPartitions(processors, options.num_chains,
                            serial.sweep->method.block_size)) {
        rows.push_back(MakeRow(options, serial, *baseline, partition,
                               processors, predictor));
      }
    }
  }
  return rows;
}

const PredictedRow& RuleOf(const std::vector<PredictedRow>& rows) {
  return *std::max_element(
      rows.begin(), rows.end(), [](const auto& a, const auto& b) {
        const auto key = [](const PredictedRow& row) {
          return std::tuple(row.partition.num_tasks(),
                            row.partition.chain_tasks, -row.method.block_size,
                            row.method.num_values);
        };
        return key(a) < key(b);
      });
}

const PredictedRow& BestOf(const std::vector<PredictedRow>& rows) {
  return *std::max_element(
      rows.begin(), rows.end(),
      [](const auto& a, const auto& b) { return a.S_T.value < b.S_T.value; });
}

}  // namespace bench::predict
