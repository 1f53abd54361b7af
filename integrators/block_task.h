#pragma once

#include <exception>
#include <memory>
#include <vector>

#include "integrators/block_run.h"

namespace integrators {

// One task of a run: the blocks of Figures 2, 3, 7 and 8, for the chains and
// the block points that this task owns. The figures are written in these words;
// what they add is who waits for whom.
//
// Use: by its own task only. Between calls of several tasks, the figure must
// synchronize as each call says. No call allocates.
class alignas(macrotask::kCacheLine) BlockTask {
 public:
  // Task (i, k), both counted from 0: integration task i < p^, chain task k <
  // m^. `factory` is the run's.
  BlockTask(BlockRun* run, int i, int k, EvaluationFactory* factory);

  int num_blocks() const { return run_.num_blocks; }

  // CS, compute state: the predicted states of the owned points of the next
  // block. Requires the shift of the block before.
  void Predict();

  // CS: the corrected states. Requires the predicted derivatives of all points
  // of the column.
  void Correct();

  // OCD of the owned chains at the owned points.
  void Ocd(Phase phase);

  // RMA at the owned points, on the own copy of the common state. Requires OCD
  // of all chains at these points.
  void Rma(Phase phase);

  // CCD of the owned chains at the owned points. Requires RMA.
  void Ccd(Phase phase);

  // Shifts the blocks of the column; if any point failed, ends the run instead.
  // Requires the corrected derivatives of all its points, and that no other
  // task computes with the column meanwhile. All columns come to the same
  // decision: every chain task of a point sees what all chains left for RMA,
  // and every column sees all points.
  void ShiftBlocks();

  // Whether the last shift ended the run. Only the task that shifts may look at
  // the failures themselves: it may be computing the next block already, and
  // failing in it, when the others ask.
  bool Ended() const { return column_.ended(); }

  // What the system's user code threw in this task since the last call.
  std::exception_ptr TakeError() { return evaluation_->TakeError(); }

 private:
  // Where everything is when the block is at one place of the column's ring.
  struct Place {
    const double* y0;
    std::vector<const double*> predictor_f, corrector_f;  // (k)
    std::vector<double*> y, f[2];  // (points)  derivatives by phase
    // By pair and by point; derivatives also by phase.
    std::vector<const double*> chain_states, common_states;
    std::vector<double*> chain_rates[2], common_rates[2];
  };

  int num_points() const { return static_cast<int>(times_.size()); }
  int point(int local) const { return first_point_ + local; }  // 1 ... b
  Place MakePlace(int place);
  void Combine(const std::vector<std::vector<double>>& weights,
               const std::vector<const double*>& f);

  BlockRun& run_;
  Column& column_;
  Failure& failure_;      // this task's
  const int rma_column_;  // chain task whose RMA this task's CCD reads
  const int first_point_;
  std::vector<double> times_;  // (points)  s
  std::vector<int> codes_;     // (points)
  std::unique_ptr<Evaluation> evaluation_;

  AlignedDoubles own_coupling_;
  double* coupling_;  // (points x coupling size)
  std::vector<std::vector<double>> predictor_weights_;  // (points x k)  times h
  std::vector<std::vector<double>> corrector_weights_;  // (points x k)  times h
  std::vector<Place> places_;
  const Place* place_ = nullptr;  // of the current block
};

}  // namespace integrators
