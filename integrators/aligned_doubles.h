#pragma once

#include <cstddef>
#include <memory>
#include <new>

#include "macrotask/cache_line.h"

namespace integrators {

// A vector of doubles that begins on a cache line of its own and ends with one:
// no two of them share a line, and loops over it need no remainder. Filled with
// zeros.
class AlignedDoubles {
 public:
  static constexpr std::size_t kDoublesPerLine =
      macrotask::kCacheLine / sizeof(double);

  // Room for at least `size` values.
  explicit AlignedDoubles(std::size_t size = 0)
      : size_((size + kDoublesPerLine - 1) / kDoublesPerLine * kDoublesPerLine),
        values_(static_cast<double*>(::operator new[](
            size_ * sizeof(double), std::align_val_t(macrotask::kCacheLine)))) {
    std::uninitialized_fill_n(values_.get(), size_, 0.0);
  }

  double* data() { return values_.get(); }
  const double* data() const { return values_.get(); }
  std::size_t size() const { return size_; }  // rounded up

 private:
  struct Deleter {
    void operator()(double* values) const {
      ::operator delete[](values, std::align_val_t(macrotask::kCacheLine));
    }
  };

  std::size_t size_;
  std::unique_ptr<double[], Deleter> values_;
};

}  // namespace integrators
