#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "integrators/aligned_doubles.h"
#include "integrators/block_run.h"

namespace integrators {

// Fills the full state y and its derivative f at grid point n, where they are
// known beforehand.
using ExactValues = std::function<void(int n, double* y, double* f)>;

// How a block method comes by the k derivatives that it starts from: computed
// by Dormand & Prince's fifth-order Runge-Kutta method, one step per h, or
// given. Serial, with a share of the evaluation of its own (all chains, one
// point), so that every partition starts from the same bits.
class Start {
 public:
  explicit Start(const System& system);

  // Computes the grid points 0 ... run->num_start_steps from the state y0 (full
  // vector) and puts them into the columns. Returns the evaluations that it
  // took. Throws IntegrationError.
  int Dopri5(const double* y0, BlockRun* run);

  // The same from known values; no evaluations.
  int Exact(const ExactValues& values, BlockRun* run);

 private:
  // f = y'(t) of the full system.
  void Evaluate(double t, const double* y, double* f);
  void Step(double t, double h);
  void Record(int n, BlockRun* run) const;
  void Keep(int n, const BlockRun& run);

  const System& system_;
  StateLayout layout_;
  std::unique_ptr<EvaluationFactory> factory_;
  std::unique_ptr<Evaluation> evaluation_;
  std::vector<const double*> chain_states_;
  std::vector<double*> chain_rates_;
  std::vector<double> coupling_;
  AlignedDoubles y_, stage_y_;
  std::vector<AlignedDoubles> stage_f_;  // (7)
  std::vector<AlignedDoubles> history_;  // (k)  oldest first
};

}  // namespace integrators
