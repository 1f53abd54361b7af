#pragma once

#include <vector>

// The arithmetic of measurement, as free functions.

namespace bench {

// A range that holds the unknown with the stated probability.
struct Interval {
  double low;
  double high;
};

// Middle value; the mean of the two middle ones of an even number. Requires at
// least one sample.
double Median(std::vector<double> samples);

// Nonparametric 95 % confidence interval of the median: order statistics whose
// ranks bound the binomial distribution of the number of samples below it. With
// fewer than six samples there is none; then the range of all samples.
Interval MedianInterval(std::vector<double> samples);

// The value that the share `p` in [0, 1] of the samples does not exceed,
// interpolated between neighbours: 0 gives the least, 1 the greatest. Requires at
// least one sample.
double Percentile(std::vector<double> samples, double p);

// What a table says of samples.
struct Summary {
  double median;
  Interval interval;  // of the median, 95 %
  double min;
  double p95;
  int n;
};
Summary Summarize(const std::vector<double>& samples);

// a[i] / b[i].
std::vector<double> Ratios(const std::vector<double>& a,
                           const std::vector<double>& b);

// The line log(y) = intercept + slope log(x) with the least squared error of
// log(y). Requires two or more points with different x, all positive.
struct PowerLaw {
  double slope;
  double intercept;

  double X(double y) const;  // where the line takes the value y
};
PowerLaw FitPowerLaw(const std::vector<double>& x,
                     const std::vector<double>& y);

}  // namespace bench
