#include "integrators/combine.h"

#include "integrators/aligned_doubles.h"

namespace integrators {
namespace {

constexpr std::size_t kLine = AlignedDoubles::kDoublesPerLine;

// With the number of terms known, all of it stays in registers; 0 stands for
// any number. `y` overlaps nothing that is read: without that promise GCC does
// not vectorize.
template <std::size_t kTerms>
void CombineTerms(std::size_t size, const double* y0,
                  std::span<const double> weights, const double* const* f,
                  double* __restrict y) {
  const std::size_t terms = kTerms > 0 ? kTerms : weights.size();
  for (std::size_t first = 0; first < size; first += kLine) {
    double sum[kLine];
    for (std::size_t e = 0; e < kLine; ++e) sum[e] = y0[first + e];
#pragma GCC unroll 8
    for (std::size_t j = 0; j < terms; ++j) {
      const double w = weights[j];
      const double* f_j = f[j] + first;
#pragma GCC unroll 8
      for (std::size_t e = 0; e < kLine; ++e) sum[e] += w * f_j[e];
    }
    for (std::size_t e = 0; e < kLine; ++e) y[first + e] = sum[e];
  }
}

}  // namespace

void Combine(std::size_t size, const double* y0,
             std::span<const double> weights, const double* const* f,
             double* y) {
  switch (weights.size()) {
    case 5:  // the paper's methods
      return CombineTerms<5>(size, y0, weights, f, y);
    case 6:
      return CombineTerms<6>(size, y0, weights, f, y);
    default:
      return CombineTerms<0>(size, y0, weights, f, y);
  }
}

}  // namespace integrators
