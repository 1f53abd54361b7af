#pragma once

#include <cstddef>
#include <span>

namespace integrators {

// y = y0 + sum_j weights[j] f[j], element by element, the sum in order of j:
// the formula of every predictor and corrector. Compiled once, out of line, so
// that each caller gets the same bits. `size` is a multiple of
// AlignedDoubles::kDoublesPerLine, all vectors are aligned as those are, and y
// overlaps none of the others.
void Combine(std::size_t size, const double* y0,
             std::span<const double> weights, const double* const* f,
             double* y);

}  // namespace integrators
