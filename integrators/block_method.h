#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "integrators/rational.h"

namespace integrators {

// A block predictor-corrector method BbPCk of Birta & Abou-Rabia [MSO93 section
// 3], in PECE form: from y_0 and derivatives at grid points it predicts b
// points at once, evaluates, corrects them from y_0, and evaluates again. Two
// derivative evaluations a point. With h the step and offsets counted in steps
// from y_0, point i = 1 ... b is
//
//   predictor  y_i^p = y_0 + h sum_j predictor[i - 1][j] f_(j - k + 1)
//   corrector  y_i^c = y_0 + h sum_j corrector[i - 1][j] f_(j - k + 1 + b)
//
// so that the predictor reads f_-(k-1) ... f_0, and the corrector the k newest
// of ..., f_0, f_1^p, ..., f_b^p.
struct BlockMethod {
  int block_size = 0;  // b
  int num_values = 0;  // k derivative values in each formula
  std::vector<std::vector<Rational>> predictor;  // (b x k)
  std::vector<std::vector<Rational>> corrector;  // (b x k)

  std::string name() const;  // "B4PC5"
  // Offset of the oldest derivative that a corrector reads: b - k + 1.
  int first_corrector_offset() const { return block_size - num_values + 1; }
};

// The method with the given b >= 1 and k >= 2, k > b (the corrector reads f_0).
// Weights are exact: point i integrates the polynomial of degree k - 1 through
// its k derivative values from 0 to i. Throws std::invalid_argument otherwise,
// std::overflow_error when k is too large for 64-bit fractions.
BlockMethod MakeBlockMethod(int block_size, int num_values);

BlockMethod B1PC5();  // serial: Adams-Bashforth, Adams-Moulton
BlockMethod B2PC5();
BlockMethod B4PC5();

// The method of that name, "B<b>PC<k>". Throws std::invalid_argument, one
// sentence with the name and what was expected.
BlockMethod ParseBlockMethod(std::string_view name);

// Weights w_j with which sum_j w_j f(offsets[j]) is the integral of f from 0 to
// `end`, for every polynomial f of a degree below the number of offsets: the
// order conditions sum_j w_j offsets[j]^d = end^(d+1) / (d + 1).
std::vector<Rational> IntegrationWeights(const std::vector<int>& offsets,
                                         int end);

}  // namespace integrators
