#pragma once

#include "bench/predict/figure_program.h"
#include "bench/predict/machine.h"
#include "bench/predict/program.h"
#include "integrators/state_layout.h"

namespace bench::predict {

// Sizes of a system's parts, in doubles.
struct SystemSizes {
  int chain = 12;     // the state of one chain: 6 joints
  int common = 13;    // that of the reference member
  int tip_lines = 4;  // cache lines through which a chain's tip reaches RMA
};

// By what the cost of a block grows, for the share of one task; see BlockCost.
//
//            packs                        items
//   start    -                            doubles copied: k full states
//   CS       points                       points x k x doubles of the column
//   OCD      registers full of pairs      pairs of chain and point
//   RMA      registers full of points     points x chains of the system
//   CCD      registers full of pairs      pairs
//   shift    -                            -
//
// `lines` that other tasks have written and this one reads: in CS, derivatives
// at the other points of its column; in RMA, the tips of the other chains.
struct Counts {
  double packs = 0;
  double items = 0;
  double lines = 0;
};

// A share: chains x points of task (i, k).
struct TaskShare {
  int chains;
  int points;
};
TaskShare ShareOf(const FigureCase& figure_case, int i, int k);

// `lines` are those that tasks on other processors have written, with
// `num_processors` of them and the tasks placed as macrotask::Placement does.
Counts CountsOf(Block block, const FigureCase& figure_case,
                const SystemSizes& sizes, int num_lanes, int task,
                int num_processors);

// What a run costs besides its blocks.
struct RunCosts {
  int num_lanes = 4;
  double work = 0;                      // s, for each pair, in OCD
  double point_line = 0, tip_line = 0;  // s, as in Condition
  double slowdown = 1;                  // MachineModel::SlowdownOn()
  int num_processors = 1;
};

// Gives every kCompute step of a figure's program its time.
void SetCosts(const FigureCase& figure_case, const SystemSizes& sizes,
              const BlockCosts& blocks, const RunCosts& costs,
              Program* program);

}  // namespace bench::predict
