#include "tests/support/model_system.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace support {

std::string ModelSystem::DescribeFailure(int code) const {
  return "chain " + std::to_string(code - 1) + " fails";
}

std::vector<double> ModelSystem::Solution(double t) const {
  std::vector<double> y;
  for (int k = 0; k < num_chains_; ++k) {
    y.insert(y.end(), {std::sin(t + k), std::cos(t + k)});
    if (chain_size(k) == 3) y.push_back(std::exp(-t));
  }
  y.insert(y.end(), {std::cos(t), std::sin(t)});
  return y;
}

std::vector<double> ModelSystem::SolutionRate(double t) const {
  std::vector<double> rate;
  for (int k = 0; k < num_chains_; ++k) {
    rate.insert(rate.end(), {std::cos(t + k), -std::sin(t + k)});
    if (chain_size(k) == 3) rate.push_back(-std::exp(-t));
  }
  rate.insert(rate.end(), {-std::sin(t), std::cos(t)});
  return rate;
}

double ModelSystem::SolutionCoupling(double t) const {
  double c = std::cos(t);
  for (int k = 0; k < num_chains_; ++k) c += (1 + 0.1 * k) * std::sin(t + k);
  return c;
}

ModelSystem::Exchange ModelSystem::MakeExchange(int num_points) const {
  return {num_points, num_chains_,
          std::vector<double>(
              static_cast<std::size_t>(2 * num_points * num_chains_))};
}

ModelSystem::Evaluator ModelSystem::MakeEvaluator(int first_chain,
                                                  int num_chains,
                                                  int first_point,
                                                  int num_points,
                                                  Exchange* exchange) const {
  return Evaluator(*this, first_chain, num_chains, first_point, num_points,
                   exchange);
}

ModelSystem::Evaluator::Evaluator(const ModelSystem& system, int first_chain,
                                  int num_chains, int first_point,
                                  int num_points, Exchange* exchange)
    : system_(system),
      first_chain_(first_chain),
      num_chains_(num_chains),
      first_point_(first_point),
      exchange_(*exchange),
      times_(static_cast<std::size_t>(num_points)),
      states_(static_cast<std::size_t>(num_points * num_chains)) {}

void ModelSystem::Evaluator::Ocd(int set, std::span<const double> times,
                                 std::span<const double* const> states) {
  std::copy(times.begin(), times.end(), times_.begin());
  std::copy(states.begin(), states.end(), states_.begin());
  for (std::size_t pair = 0; pair < states_.size(); ++pair) {
    const int local = static_cast<int>(pair);
    const int point = local / num_chains_;
    const int k = first_chain_ + local % num_chains_;
    double value = (1 + 0.1 * k) * states_[pair][0];
    const Fault& fault = system_.fault_;
    if (fault.chain == k &&
        times_[static_cast<std::size_t>(point)] >= fault.time) {
      value = std::numeric_limits<double>::quiet_NaN();
      if (fault.kind == Fault::kThrows && !error_) {
        error_ = std::make_exception_ptr(std::runtime_error("chain throws"));
      }
    }
    exchange_.value(set, first_point_ + point, k) = value;
  }
}

void ModelSystem::Evaluator::Rma(int set, std::span<const double* const> states,
                                 std::span<double* const> rates,
                                 double* coupling, std::span<int> failures) {
  for (std::size_t point = 0; point < times_.size(); ++point) {
    double sum = 0;
    failures[point] = 0;
    for (int k = 0; k < system_.num_chains(); ++k) {
      const double value =
          exchange_.value(set, first_point_ + static_cast<int>(point), k);
      sum += value;
      if (std::isnan(value) && failures[point] == 0) failures[point] = k + 1;
    }
    const double* z = states[point];
    coupling[point] = sum + z[0];
    const double miss =
        coupling[point] - system_.SolutionCoupling(times_[point]);
    rates[point][0] = -z[1] + 0.3 * miss;
    rates[point][1] = z[0] - 0.1 * miss * z[1];
  }
}

void ModelSystem::Evaluator::Ccd(const double* coupling,
                                 std::span<double* const> rates) {
  for (std::size_t pair = 0; pair < states_.size(); ++pair) {
    const std::size_t point = pair / static_cast<std::size_t>(num_chains_);
    const int k = first_chain_ + static_cast<int>(pair) % num_chains_;
    const double* y = states_[pair];
    const double miss =
        coupling[point] - system_.SolutionCoupling(times_[point]);
    rates[pair][0] = y[1] + 0.2 * miss;
    rates[pair][1] = -y[0] - 0.5 * (y[0] * y[0] + y[1] * y[1] - 1) * y[1];
    if (system_.chain_size(k) == 3) rates[pair][2] = -y[2] + 0.1 * miss;
  }
}

std::exception_ptr ModelSystem::Evaluator::TakeError() {
  return std::exchange(error_, nullptr);
}

}  // namespace support
