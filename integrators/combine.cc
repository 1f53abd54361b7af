#include "integrators/combine.h"

#include "integrators/aligned_doubles.h"

namespace integrators {

void Combine(std::size_t size, const double* y0,
             std::span<const double> weights, const double* const* f,
             double* y) {
  constexpr std::size_t kLine = AlignedDoubles::kDoublesPerLine;
  for (std::size_t first = 0; first < size; first += kLine) {
    double sum[kLine];
    for (std::size_t e = 0; e < kLine; ++e) sum[e] = y0[first + e];
    for (std::size_t j = 0; j < weights.size(); ++j) {
      const double w = weights[j];
      const double* f_j = f[j] + first;
      for (std::size_t e = 0; e < kLine; ++e) sum[e] += w * f_j[e];
    }
    for (std::size_t e = 0; e < kLine; ++e) y[first + e] = sum[e];
  }
}

}  // namespace integrators
