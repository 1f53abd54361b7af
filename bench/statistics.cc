#include "bench/statistics.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace bench {

double Median(std::vector<double> samples) {
  if (samples.empty()) throw std::invalid_argument("no samples");
  std::sort(samples.begin(), samples.end());
  const std::size_t n = samples.size();
  return n % 2 == 1 ? samples[n / 2]
                    : (samples[n / 2 - 1] + samples[n / 2]) / 2;
}

Interval MedianInterval(std::vector<double> samples) {
  if (samples.empty()) throw std::invalid_argument("no samples");
  std::sort(samples.begin(), samples.end());
  const auto n = static_cast<double>(samples.size());
  // P(X < rank) for X ~ Binomial(n, 1/2), added up until it passes 2.5 %.
  double log_term = -n * std::log(2.0);
  double below = 0;
  std::size_t rank = 0;
  while (below + std::exp(log_term) <= 0.025) {
    below += std::exp(log_term);
    const auto r = static_cast<double>(rank);
    log_term += std::log((n - r) / (r + 1));
    ++rank;
  }
  if (rank > 0) --rank;
  return {samples[rank], samples[samples.size() - 1 - rank]};
}

double Percentile(std::vector<double> samples, double p) {
  if (samples.empty()) throw std::invalid_argument("no samples");
  std::sort(samples.begin(), samples.end());
  const double place =
      std::clamp(p, 0.0, 1.0) * static_cast<double>(samples.size() - 1);
  const double below = std::floor(place);
  const auto i = static_cast<std::size_t>(below);
  if (i + 1 == samples.size()) return samples.back();
  return samples[i] + (place - below) * (samples[i + 1] - samples[i]);
}

Summary Summarize(const std::vector<double>& samples) {
  return {.median = Median(samples),
          .interval = MedianInterval(samples),
          .min = Percentile(samples, 0),
          .p95 = Percentile(samples, 0.95),
          .n = static_cast<int>(samples.size())};
}

std::vector<double> Ratios(const std::vector<double>& a,
                           const std::vector<double>& b) {
  if (a.size() != b.size()) {
    throw std::invalid_argument("ratios of different numbers of samples");
  }
  std::vector<double> ratios;
  for (std::size_t i = 0; i < a.size(); ++i) ratios.push_back(a[i] / b[i]);
  return ratios;
}

double PowerLaw::X(double y) const {
  return std::exp((std::log(y) - intercept) / slope);
}

PowerLaw FitPowerLaw(const std::vector<double>& x,
                     const std::vector<double>& y) {
  if (x.size() != y.size() || x.size() < 2) {
    throw std::invalid_argument("a line needs two points or more");
  }
  const auto n = static_cast<double>(x.size());
  double mean_x = 0, mean_y = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    mean_x += std::log(x[i]) / n;
    mean_y += std::log(y[i]) / n;
  }
  double xx = 0, xy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double dx = std::log(x[i]) - mean_x;
    xx += dx * dx;
    xy += dx * (std::log(y[i]) - mean_y);
  }
  if (!(xx > 0)) throw std::invalid_argument("a line needs different x");
  const double slope = xy / xx;
  return {slope, mean_y - slope * mean_x};
}

}  // namespace bench
