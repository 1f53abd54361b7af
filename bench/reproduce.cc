#include "bench/reproduce.h"

#include <algorithm>
#include <cstring>
#include <map>
#include <memory>
#include <stdexcept>
#include <utility>

#include "bench/predict/calibration.h"
#include "bench/progress.h"
#include "macrotask/placement.h"
#include "macrotask/trace.h"

namespace bench {
namespace {

using dynamics::Lanes;
using integrators::BlockMethod;
using integrators::Figure;
using integrators::Integration;
using integrators::IntegrationOptions;
using integrators::IntegrationResult;
using integrators::Partition;

IntegrationOptions OptionsFor(const BlockMethod& method, const LiftCase& lift,
                              Partition partition, macrotask::WaitPolicy wait) {
  return {
      .method = method,
      .step = lift.step(),
      .num_steps = lift.num_steps(),
      .figure = partition.num_tasks() == 1 ? Figure::kSerial : Figure::kFigure8,
      .partition = partition,
      .wait = wait};
}

bool SameBits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() &&
         std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

// One row while it is measured.
struct RunningRow {
  TableRow* row;
  std::unique_ptr<Integration> integration;
  const LiftCase* lift;
};

// One method's input, at the whole number of steps that reaches the target.
struct MethodCase {
  MethodCase(const MethodSweep& of, Lanes lanes)
      : sweep(of),
        lift(dynamics::PumaLift(), WholeSteps(of)),
        system(lift.lift().model, lift.torques(), lanes) {}

  const MethodSweep& sweep;
  LiftCase lift;
  dynamics::ClosedChainSystem system;
  std::vector<double> serial_state;
};

class LaneMeasurement {
 public:
  LaneMeasurement(const std::vector<MethodSweep>& sweeps, Lanes lanes,
                  macrotask::WaitPolicy wait)
      : wait_(wait), tables_{.lanes = lanes, .rows = {}, .lift = {}} {
    for (const MethodSweep& sweep : sweeps) {
      cases_.emplace(sweep.method.block_size,
                     std::make_unique<MethodCase>(sweep, lanes));
    }
    const int processors = macrotask::NumProcessors();
    constexpr int kNumChains = 4;
    tables_.rows = Table2Rows(processors, kNumChains);
    for (TableRow& row : tables_.rows) Prepare(row, processors);
    PrepareLift();
  }

  // Once through all rows that this machine can run. Each runs twice; the first
  // time warms the caches of the processors that it uses.
  void Repeat() {
    for (RunningRow& running : running_) {
      running.integration->RunFrom(running.lift->Planned());
      const IntegrationResult result =
          running.integration->RunFrom(running.lift->Planned());
      running.row->seconds.push_back(result.seconds());
    }
    lift_->Run(lift_start_);
    tables_.lift.seconds.push_back(lift_->Run(lift_start_).seconds());
  }

  LaneTables Take() { return std::move(tables_); }

 private:
  // Runs the row once, for correctness; keeps it if there are processors for
  // its tasks.
  void Prepare(TableRow& row, int processors) {
    MethodCase& method = *cases_.at(row.block_size);
    auto integration = std::make_unique<Integration>(
        method.system,
        OptionsFor(method.sweep.method, method.lift, row.partition, wait_));
    const IntegrationResult result =
        integration->RunFrom(method.lift.Planned());
    // The serial rows come first.
    if (method.serial_state.empty()) method.serial_state = result.state;
    row.same_bits = SameBits(result.state, method.serial_state);
    row.steps = method.lift.num_steps();
    row.scale = method.sweep.steps_at_target / row.steps;
    if (row.processors() > processors) return;
    running_.push_back({&row, std::move(integration), &method.lift});
  }

  void PrepareLift() {
    MethodCase& method = *cases_.at(1);
    lift_ = std::make_unique<Integration>(
        method.system, OptionsFor(method.sweep.method, method.lift, {}, wait_));
    lift_start_ = method.lift.InitialState();
    tables_.lift.steps = method.lift.num_steps();
    tables_.lift.error = method.lift.Error(lift_->Run(lift_start_).state);
  }

  macrotask::WaitPolicy wait_;
  LaneTables tables_;
  std::map<int, std::unique_ptr<MethodCase>> cases_;  // by block size
  std::vector<RunningRow> running_;
  std::unique_ptr<Integration> lift_;
  std::vector<double> lift_start_;
};

// Needs two processors, to see what waiting costs, and the history trace for
// itself.
bool CanPredict(const ReproduceOptions& options) {
  return options.predict && macrotask::NumProcessors() >= 2 &&
         macrotask::TraceClasses() == 0;
}

void PredictRows(const predict::MachineModel& machine,
                 const ReproduceOptions& options,
                 const std::vector<MethodSweep>& sweeps, LaneTables* tables) {
  predict::Predictor predictor(machine, {});
  predict::TableOptions table;
  table.num_lanes = static_cast<int>(tables->lanes);
  table.wait = options.wait.kind;
  for (const TableRow& row : tables->rows) {
    const auto known = std::find(table.processors.begin(),
                                 table.processors.end(), row.processors());
    if (!row.measured() && known == table.processors.end()) {
      table.processors.push_back(row.processors());
    }
  }
  const auto predicted = predict::PredictRows(table, sweeps, &predictor);
  for (TableRow& row : tables->rows) {
    if (row.measured()) continue;
    for (const predict::PredictedRow& candidate : predicted) {
      const bool same =
          candidate.method.block_size == row.block_size &&
          candidate.processors == row.processors() &&
          candidate.partition.chain_tasks == row.partition.chain_tasks;
      if (same) row.predicted = candidate;
    }
  }
}

}  // namespace

std::vector<TableRow> Table2Rows(int processors, int num_chains) {
  std::vector<TableRow> rows;
  const auto add = [&](Partition partition, int block_size,
                       const PaperRow* paper) {
    TableRow row = {};
    row.partition = partition;
    row.block_size = block_size;
    row.paper = paper;
    rows.push_back(std::move(row));
  };
  const auto has = [&](Partition partition, int block_size) {
    for (const PaperRow& paper : kPaperTable2) {
      if (paper.chain_tasks == partition.chain_tasks &&
          paper.integration_tasks == partition.integration_tasks &&
          paper.block_size == block_size) {
        return true;
      }
    }
    return false;
  };
  bool own_added = false;
  for (const PaperRow& paper : kPaperTable2) {
    if (paper.processors > 1 && !own_added) {
      own_added = true;
      for (const int block_size : {4, 2, 1}) {
        for (int m = 1; m <= num_chains; ++m) {
          const int p = processors / m;
          const bool divides =
              m * p == processors && num_chains % m == 0 && block_size % p == 0;
          if (processors > 1 && divides && p <= block_size &&
              !has({m, p}, block_size)) {
            add({m, p}, block_size, nullptr);
          }
        }
      }
    }
    add({paper.chain_tasks, paper.integration_tasks}, paper.block_size, &paper);
  }
  return rows;
}

const MethodSweep& SweepOf(const Reproduction& reproduction, int block_size) {
  for (const MethodSweep& sweep : reproduction.sweeps) {
    if (sweep.method.block_size == block_size) return sweep;
  }
  throw std::out_of_range("no sweep of that block size");
}

const TableRow& SerialRow(const LaneTables& tables, int block_size) {
  for (const TableRow& row : tables.rows) {
    if (row.block_size == block_size && row.processors() == 1) return row;
  }
  throw std::out_of_range("no serial row of that block size");
}

Reproduction Reproduce(const ReproduceOptions& options) {
  Progress progress;
  Reproduction result;
  result.machine = DescribeMachine();
  // Only what has a processor for each task is timed.
  result.wait = options.wait.For(macrotask::NumProcessors());
  result.placement =
      macrotask::Placement(macrotask::NumProcessors()).ToString();
  result.sweeps = SweepMethods(
      {integrators::B4PC5(), integrators::B2PC5(), integrators::B1PC5()},
      [] { return dynamics::PumaLift(); },
      [&](const char* what, int done, int all) {
        progress.Show(what, done, all);
      });

  std::vector<LaneMeasurement> measurements;
  measurements.reserve(2);  // rows are pointed to
  for (const Lanes lanes : {Lanes::kFour, Lanes::kOne}) {
    measurements.emplace_back(result.sweeps, lanes, options.wait);
  }
  for (int r = 0; r < options.repetitions; ++r) {
    progress.Show("measure", r, options.repetitions);
    for (LaneMeasurement& measurement : measurements) measurement.Repeat();
  }
  for (LaneMeasurement& measurement : measurements) {
    result.lanes.push_back(measurement.Take());
  }
  if (CanPredict(options)) {
    predict::CalibrationOptions calibration;
    calibration.hold_time = result.wait.hold_time;
    const predict::MachineModel machine = predict::Calibrate(
        calibration,
        [&](int done, int all) { progress.Show("calibrate", done, all); });
    for (LaneTables& tables : result.lanes) {
      PredictRows(machine, options, result.sweeps, &tables);
    }
  }

  const LiftCase middle(dynamics::PumaLift(), 100);
  result.costs = MeasureBlocks(middle, options.repetitions);
  for (Cost& cost : MeasureSynchronization(result.wait, options.repetitions)) {
    result.costs.push_back(std::move(cost));
  }
  return result;
}

}  // namespace bench
