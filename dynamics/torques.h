#pragma once

#include <Eigen/Core>
#include <functional>
#include <utility>
#include <vector>

#include "dynamics/model.h"

namespace dynamics {

// Where the joint torques of a simulation come from.
class TorqueSource {
 public:
  virtual ~TorqueSource() = default;

  // Throws std::invalid_argument, one sentence, if it cannot serve the model.
  virtual void CheckFits(const SystemModel& /*model*/) const {}

  // Fills tau[0..N) (N m or N) with the torques of chain k at the time t (s)
  // when it is in the state q, qd (N values each). Called by many tasks at
  // once, each for chains and times of its own: must be safe for that and must
  // not allocate.
  virtual void Calc(int k, double t, const double* q, const double* qd,
                    double* tau) const = 0;
};

// Torques as a function of time and state: a controller.
class TorqueFunction final : public TorqueSource {
 public:
  using Function = std::function<void(int k, double t, const double* q,
                                      const double* qd, double* tau)>;
  explicit TorqueFunction(Function function) : function_(std::move(function)) {}

  void Calc(int k, double t, const double* q, const double* qd,
            double* tau) const override {
    function_(k, t, q, qd, tau);
  }

 private:
  Function function_;
};

// Torques as a profile, computed beforehand: a table on the grid t = 0, step, 2
// step, ... At a time of the grid the tabled value is used as it is; between,
// the polynomial through the six nearest times (so that a start by a method of
// order five keeps its order).
class TorqueTable final : public TorqueSource {
 public:
  // `profile[k]` is (N_k x times), column n for the time n step. Throws
  // std::invalid_argument, naming the chain, the joint and the time, if a value
  // is not finite; or if there are fewer than six times, or the chains differ
  // in how many.
  TorqueTable(double step, std::vector<Eigen::MatrixXd> profile);

  void CheckFits(const SystemModel& model) const override;

  // Throws std::out_of_range if t is outside of the table by more than a
  // rounding error.
  void Calc(int k, double t, const double* q, const double* qd,
            double* tau) const override;

  double step() const { return step_; }
  double duration() const { return step_ * static_cast<double>(times_ - 1); }

 private:
  double step_;
  Eigen::Index times_;
  std::vector<Eigen::MatrixXd> profile_;
};

}  // namespace dynamics
