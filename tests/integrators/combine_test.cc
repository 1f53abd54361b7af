#include "integrators/combine.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "integrators/aligned_doubles.h"

namespace integrators {
namespace {

TEST(Combine, IsTheWeightedSumForAnyNumberOfTerms) {
  for (std::size_t terms = 0; terms <= 9; ++terms) {
    AlignedDoubles y0(21), y(21);
    std::vector<AlignedDoubles> f;
    std::vector<const double*> pointers;
    std::vector<double> weights;
    for (std::size_t j = 0; j < terms; ++j) {
      f.emplace_back(21);
      weights.push_back(0.3 * static_cast<double>(j) - 1);
      for (std::size_t e = 0; e < f[j].size(); ++e) {
        f[j].data()[e] = std::sin(static_cast<double>(7 * j + e));
      }
    }
    for (const AlignedDoubles& values : f) pointers.push_back(values.data());
    for (std::size_t e = 0; e < y0.size(); ++e) {
      y0.data()[e] = static_cast<double>(e);
    }

    Combine(y.size(), y0.data(), weights, pointers.data(), y.data());

    for (std::size_t e = 0; e < y.size(); ++e) {
      long double sum = y0.data()[e];
      for (std::size_t j = 0; j < terms; ++j)
        sum += weights[j] * f[j].data()[e];
      // Nine roundings of a sum below 40.
      EXPECT_NEAR(y.data()[e], static_cast<double>(sum), 9 * 40 * 0x1p-53);
    }
  }
}

TEST(AlignedDoubles, EndsWithAWholeCacheLineOfItsOwn) {
  const AlignedDoubles values(61);
  EXPECT_EQ(values.size(), 64u);
  EXPECT_EQ(
      reinterpret_cast<std::uintptr_t>(values.data()) % macrotask::kCacheLine,
      0u);
  EXPECT_EQ(values.data()[63], 0.0);
}

}  // namespace
}  // namespace integrators
