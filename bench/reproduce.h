#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/costs.h"
#include "bench/lift_case.h"
#include "bench/machine.h"
#include "bench/paper.h"
#include "bench/predict/prediction_table.h"
#include "bench/statistics.h"
#include "bench/sweep.h"

namespace bench {

struct ReproduceOptions {
  int repetitions = 200;
  macrotask::WaitPolicy wait = {};
  bool predict = true;  // the rows that need more processors
};

// One row of Table 2 (and of Table 1, if the block has four points).
struct TableRow {
  int processors() const { return partition.num_tasks(); }
  bool measured() const { return !seconds.empty(); }

  integrators::Partition partition;
  int block_size;
  const PaperRow* paper;  // null if the paper has no such row
  // Whether the states are, bit for bit, those of the serial program.
  bool same_bits = false;
  // The lift's time in each repetition (s), with this number of steps. Empty if
  // the row needs more processors than there are.
  std::vector<double> seconds;
  int steps = 0;
  // From those steps to the number, not a whole one, for 1e-6 m: T is the time
  // times this.
  double scale = 1;
  // What a row that needs more processors would give on them, if this machine
  // had them. Nothing in a measured row.
  std::optional<predict::PredictedRow> predicted = {};
};

// The lift with B1PC5 on one processor, its DOPRI5 start included.
struct LiftRun {
  int steps;
  double error;                 // m
  std::vector<double> seconds;  // by repetition
};

struct LaneTables {
  dynamics::Lanes lanes;
  std::vector<TableRow> rows;
  LiftRun lift;
};

struct Reproduction {
  Machine machine;
  std::string placement;
  macrotask::WaitPolicy wait = {};
  std::vector<MethodSweep> sweeps;  // B4PC5, B2PC5, B1PC5
  std::vector<LaneTables> lanes;    // four, one
  std::vector<Cost> costs;
};

// Runs the canonical experiment.
Reproduction Reproduce(const ReproduceOptions& options);

// The rows of Table 2 for a machine of that many processors: the paper's, with
// those that use all of this machine's processors behind the serial ones.
std::vector<TableRow> Table2Rows(int processors, int num_chains);

const MethodSweep& SweepOf(const Reproduction& reproduction, int block_size);
const TableRow& SerialRow(const LaneTables& tables, int block_size);

}  // namespace bench
