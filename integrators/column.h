#pragma once

#include <cstddef>
#include <vector>

#include "integrators/aligned_doubles.h"
#include "integrators/block_method.h"
#include "integrators/state_layout.h"
#include "macrotask/cache_line.h"

namespace integrators {

// The integration of some chains, and of a copy of the common state: states and
// derivatives at the grid points from -(k-1) to b around y_0. It needs its own
// values only, which is why BARSYNC(p^) joins the tasks of one column.
//
// Kept in a ring, so that a shift moves no data: what a task has computed stays
// in its cache, and others fetch only what they have not read before. The ring
// is a whole number of blocks long; a slot always belongs to the same point of
// a block, hence to the same task.
class Column {
 public:
  // A ring with y_0 at grid point `newest`.
  Column(const BlockMethod& method, StateLayout layout, int newest);

  const StateLayout& layout() const { return layout_; }

  // Grid point of y_0.
  int newest() const { return shift_->newest; }
  // Length of the ring in blocks, and where in it the current block is.
  int num_places() const { return num_places_; }
  int place() const;

  // State and derivative at the given offset from y_0, -(k-1) ... b, when the
  // current block is at `place`: corrected values, except that y is the
  // predicted state between prediction and correction.
  AlignedDoubles& y(int place, int offset) { return y_[Slot(place, offset)]; }
  AlignedDoubles& f(int place, int offset) { return f_[Slot(place, offset)]; }
  // Derivative of the predicted state of point i = 1 ... b.
  AlignedDoubles& f_predicted(int i) {
    return f_predicted_[static_cast<std::size_t>(i - 1)];
  }

  // Back to y_0 at the grid point of the constructor.
  void Rewind() { *shift_ = {.newest = start_, .ended = false}; }

  // The end of an iteration: the last point of the block becomes y_0, and the
  // derivatives move b places into the past.
  void ShiftBlocks() { shift_->newest += block_size_; }

  // Instead of a shift: there is no next block.
  void End() { shift_->ended = true; }
  bool ended() const { return shift_->ended; }

 private:
  std::size_t Slot(int place, int offset) const;

  StateLayout layout_;
  const int start_;
  const int block_size_;
  const int num_places_;
  // Each on cache lines of its own: written by the one task that owns the
  // point, read by all of the column.
  std::vector<AlignedDoubles> y_, f_;        // (num_places b)
  std::vector<AlignedDoubles> f_predicted_;  // (b)
  // Written by the task that shifts, read by all of the column.
  struct Shift {
    int newest;
    bool ended;
  };
  macrotask::CacheAligned<Shift> shift_;
};

}  // namespace integrators
