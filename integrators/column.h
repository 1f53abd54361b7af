#pragma once

#include <vector>

#include "integrators/aligned_doubles.h"
#include "integrators/block_method.h"
#include "integrators/state_layout.h"

namespace integrators {

// What a block point computes, each on cache lines of its own: written by the
// one task that owns the point, read by all of its column.
struct PointSlots {
  explicit PointSlots(std::size_t size)
      : y(size), f_predicted(size), f_corrected(size) {}

  AlignedDoubles y;            // predicted, then corrected, state
  AlignedDoubles f_predicted;  // its derivative after the prediction
  AlignedDoubles f_corrected;  // and after the correction
};

// The integration of some chains, and of a copy of the common state: y_0, the
// derivatives f_-(k-1) ... f_0 and the points of one block. It needs its own
// values only, which is why BARSYNC(p^) joins the tasks of one column.
class Column {
 public:
  Column(const BlockMethod& method, StateLayout layout);

  const StateLayout& layout() const { return layout_; }
  AlignedDoubles& y0() { return y0_; }
  // Derivative at the offset -(k-1) ... 0.
  AlignedDoubles& f(int offset) {
    return f_[f_.size() - 1 - static_cast<std::size_t>(-offset)];
  }
  // Point i = 1 ... b.
  PointSlots& point(int i) { return points_[static_cast<std::size_t>(i - 1)]; }

  // The end of an iteration: the last point becomes y_0, and the derivatives
  // move b places into the past.
  void ShiftBlocks();

 private:
  StateLayout layout_;
  AlignedDoubles y0_;
  std::vector<AlignedDoubles> f_;   // (k)  oldest first
  std::vector<PointSlots> points_;  // (b)
};

}  // namespace integrators
