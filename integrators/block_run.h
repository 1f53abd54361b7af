#pragma once

#include <vector>

#include "integrators/aligned_doubles.h"
#include "integrators/block_method.h"
#include "integrators/column.h"
#include "integrators/system.h"
#include "macrotask/cache_line.h"

namespace integrators {

// How many tasks share the work: m^ along the chains, p^ along the points of a
// block. Results do not depend on it.
struct Partition {
  int chain_tasks = 1;        // m^
  int integration_tasks = 1;  // p^

  int num_tasks() const { return chain_tasks * integration_tasks; }
};

// What part `part` of `parts` owns of `items` things: as many or one more each.
struct Share {
  int first = 0;
  int count = 0;
};
inline Share ShareOf(int items, int parts, int part) {
  const int first = items * part / parts;
  return {first, items * (part + 1) / parts - first};
}

// The two derivative evaluations of an iteration, PE and CE.
enum class Phase { kPredicted = 0, kCorrected = 1 };

// What went wrong at one point: a code of the system's, 0 for nothing.
struct Failure {
  int code = 0;
  Phase phase = Phase::kPredicted;
  double time = 0;  // s
};

// Whether RMA is computed by every chain task on its own copy of the common
// state (Figure 3), or by one for all (Figure 2).
enum class RmaSharing { kRedundant, kSerial };

// What the tasks of one run share.
struct BlockRun {
  BlockRun(const System& system, BlockMethod method, double step, int num_steps,
           Partition partition, RmaSharing rma);

  // Grid points that the start computes, so that whole blocks remain: k - 1,
  // and what is left over of a block.
  static int NumStartSteps(const BlockMethod& method, int num_steps);

  double TimeOfGrid(int n) const { return n * step; }

  // Copies y_0 and f_-(k-1) ... f_0, full state vectors, into all columns and
  // forgets the failures of the run before.
  void SetStart(const double* y0, const std::vector<AlignedDoubles>& f);
  // Copies a vector of a column to its places in a full state vector; of the
  // copies of the common state, the first column's counts.
  void CopyToFull(const Column& column, const double* part, double* full) const;
  // The first failure of the block in which the run ended: those of the
  // prediction before those of the correction, which may only follow from them;
  // then by time, then by code.
  Failure FirstFailure() const;

  const System& system;
  const BlockMethod method;
  const double step;  // h, s
  const int num_steps;
  const Partition partition;
  const RmaSharing rma;
  const int num_start_steps;
  const int num_blocks;
  const StateLayout layout;

  std::vector<Column> columns;  // (m^)
  Failure& failure(int i, int k) {
    return *failures[static_cast<std::size_t>(i * partition.chain_tasks + k)];
  }
  // First failure of each task (i, k), written by it only when there is one:
  // the line stays shared by its readers.
  std::vector<macrotask::CacheAligned<Failure>> failures;  // (p^ x m^)
  // Where RMA leaves what CCD reads, when one task computes it for all.
  AlignedDoubles shared_coupling;
  // Where to record the full states at all grid points, if wanted:
  // (num_steps + 1) x layout.size().
  double* trajectory = nullptr;
};

}  // namespace integrators
