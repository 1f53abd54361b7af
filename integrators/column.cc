#include "integrators/column.h"

#include <algorithm>
#include <utility>

namespace integrators {
namespace {

void Copy(const AlignedDoubles& from, AlignedDoubles* to) {
  std::copy_n(from.data(), from.size(), to->data());
}

}  // namespace

Column::Column(const BlockMethod& method, StateLayout layout)
    : layout_(std::move(layout)), y0_(layout_.size()) {
  for (int j = 0; j < method.num_values; ++j) f_.emplace_back(layout_.size());
  for (int i = 0; i < method.block_size; ++i) {
    points_.emplace_back(layout_.size());
  }
}

void Column::ShiftBlocks() {
  const int b = static_cast<int>(points_.size());
  const int k = static_cast<int>(f_.size());
  // Oldest first: what is read lies b places further on, not yet written.
  for (int offset = 1 - k; offset <= 0; ++offset) {
    const int from = offset + b;
    Copy(from <= 0 ? f(from) : point(from).f_corrected, &f(offset));
  }
  Copy(point(b).y, &y0_);
}

}  // namespace integrators
