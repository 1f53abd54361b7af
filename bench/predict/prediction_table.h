#pragma once

#include <string>
#include <vector>

#include "bench/paper.h"
#include "bench/predict/prediction.h"
#include "bench/sweep.h"

// The paper's T, S_p, S_a and S_T of runs that need not have happened.

namespace bench::predict {

// A value and the middle 95 % of what the replications gave.
struct Ranged {
  double value = 0;
  Interval range = {};
};

struct PredictedRow {
  int processors = 1;
  integrators::BlockMethod method;
  integrators::Partition partition;
  Ranged T;  // s, at the steps for the target error
  Ranged S_p, S_T;
  double S_a = 1;
  TaskTimes where;  // shares of the tasks' time
  // Speedups against the serial program of the same method if
  double critical_path = 1;  //  there were processors without end
  double work_bound = 1;     //  nobody ever had to wait
  double free_sync = 1;      //  nothing cost to wait
  const PaperRow* paper = nullptr;
};

struct TableOptions {
  std::vector<int> processors;
  int num_chains = 4;
  int num_lanes = 4;
  macrotask::WaitKind wait = macrotask::WaitKind::kAuto;
  double work = 0;  // s, for each chain at each point
};

// The partitions that use so many processors well: divisors of the chains and
// of the points of a block, with at most so many tasks, and neither of them can
// be greater.
std::vector<integrators::Partition> UsefulPartitions(int processors,
                                                     int num_chains,
                                                     int block_size);

// Rows by processors, then in the order of the methods, then the more
// integration tasks the earlier, as in the paper. S_a and S_T are against
// B1PC5, which `sweeps` must have.
std::vector<PredictedRow> PredictRows(const TableOptions& options,
                                      const std::vector<MethodSweep>& sweeps,
                                      Predictor* predictor);

// The run behind a row.
RunCase CaseOf(const TableOptions& options, const MethodSweep& sweep,
               integrators::Partition partition, int processors);

// The paper's general rule: as many tasks as there are processors for, the most
// spatial parallelism, then the most accurate method. Of the rows of one number
// of processors.
const PredictedRow& RuleOf(const std::vector<PredictedRow>& rows);
// The greatest S_T.
const PredictedRow& BestOf(const std::vector<PredictedRow>& rows);

// Tables that paste as Markdown, and which row is best.
std::string TableText(const std::vector<PredictedRow>& rows);
std::string TableCsv(const std::vector<PredictedRow>& rows);

// The rows that are in the paper, beside it: errors of S_p and S_T.
std::string PaperText(const std::vector<PredictedRow>& rows);

// "B2PC5 1x2": method and partition.
std::string ConfigurationText(const PredictedRow& row);

}  // namespace bench::predict
