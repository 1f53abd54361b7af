#include "integrators/column.h"

#include <utility>

namespace integrators {

Column::Column(const BlockMethod& method, StateLayout layout, int newest)
    : layout_(std::move(layout)),
      start_(newest),
      block_size_(method.block_size),
      // k derivatives that are read and b that are written, in whole blocks.
      num_places_((method.num_values - 1) / method.block_size + 2),
      shift_{{.newest = newest, .ended = false}} {
  for (int slot = 0; slot < num_places_ * block_size_; ++slot) {
    y_.emplace_back(layout_.size());
    f_.emplace_back(layout_.size());
  }
  for (int i = 1; i <= block_size_; ++i) {
    f_predicted_.emplace_back(layout_.size());
  }
}

int Column::place() const {
  return (shift_->newest - start_) / block_size_ % num_places_;
}

// Point i of a block is at slot place b + i - 1.
std::size_t Column::Slot(int place, int offset) const {
  const int slots = num_places_ * block_size_;
  const int slot = place * block_size_ + offset - 1;
  return static_cast<std::size_t>((slot + slots) % slots);
}

}  // namespace integrators
