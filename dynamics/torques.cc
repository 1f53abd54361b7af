#include "dynamics/torques.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

namespace dynamics {
namespace {

constexpr int kNodes = 6;

void CheckFinite(const Eigen::MatrixXd& torques, int k, double step) {
  for (Eigen::Index n = 0; n < torques.cols(); ++n) {
    for (Eigen::Index i = 0; i < torques.rows(); ++i) {
      if (!std::isfinite(torques(i, n))) {
        throw std::invalid_argument(
            "the torque of chain " + std::to_string(k) + ", joint " +
            std::to_string(i + 1) +
            ", at t = " + std::to_string(step * static_cast<double>(n)) +
            " s is not a finite number");
      }
    }
  }
}

// Lagrange weights of the nodes 0 ... 5 at x.
std::array<double, kNodes> LagrangeWeights(double x) {
  std::array<double, kNodes> weights;
  for (int i = 0; i < kNodes; ++i) {
    double w = 1;
    for (int j = 0; j < kNodes; ++j) {
      if (j != i) w *= (x - j) / (i - j);
    }
    weights[i] = w;
  }
  return weights;
}

}  // namespace

TorqueTable::TorqueTable(double step, std::vector<Eigen::MatrixXd> profile)
    : step_(step), times_(0), profile_(std::move(profile)) {
  if (!(step_ > 0)) {
    throw std::invalid_argument("the torque table's step must be positive");
  }
  if (!profile_.empty()) times_ = profile_[0].cols();
  for (std::size_t k = 0; k < profile_.size(); ++k) {
    CheckFinite(profile_[k], static_cast<int>(k), step_);
    if (profile_[k].cols() != times_ || times_ < kNodes) {
      throw std::invalid_argument(
          "the torque table of chain " + std::to_string(k) + " has " +
          std::to_string(profile_[k].cols()) +
          " times: expected the same number for all chains, at least 6");
    }
  }
}

void TorqueTable::CheckFits(const SystemModel& model) const {
  if (static_cast<int>(profile_.size()) != model.num_chains()) {
    throw std::invalid_argument(
        "the torque table has " + std::to_string(profile_.size()) +
        " chains: expected " + std::to_string(model.num_chains()));
  }
  for (std::size_t k = 0; k < profile_.size(); ++k) {
    if (profile_[k].rows() != model.chains[k].arm.num_joints()) {
      throw std::invalid_argument(
          "the torque table of chain " + std::to_string(k) + " has " +
          std::to_string(profile_[k].rows()) + " joints: expected " +
          std::to_string(model.chains[k].arm.num_joints()));
    }
  }
}

void TorqueTable::Calc(int k, double t, const double* /*q*/,
                       const double* /*qd*/, double* tau) const {
  const Eigen::MatrixXd& torques = profile_[k];
  const double place = t / step_;
  const double nearest = std::nearbyint(place);
  // Times of the grid are n * step up to rounding, which is far below this.
  constexpr double kRounding = 1e-9;
  const double end = static_cast<double>(times_ - 1);
  if (!(place > -kRounding && place < end + kRounding)) {
    throw std::out_of_range(
        "the torque table ends at " + std::to_string(duration()) +
        " s: no torques at t = " + std::to_string(t) + " s");
  }
  const auto n = static_cast<Eigen::Index>(nearest);
  if (std::abs(place - nearest) < kRounding) {
    const double* column = torques.data() + n * torques.rows();
    std::copy(column, column + torques.rows(), tau);
    return;
  }
  const auto floor = static_cast<Eigen::Index>(std::floor(place));
  const Eigen::Index first =
      std::clamp<Eigen::Index>(floor - 2, 0, times_ - kNodes);
  const auto weights = LagrangeWeights(place - static_cast<double>(first));
  for (Eigen::Index i = 0; i < torques.rows(); ++i) {
    double sum = 0;
    for (int j = 0; j < kNodes; ++j) sum += weights[j] * torques(i, first + j);
    tau[i] = sum;
  }
}

}  // namespace dynamics
