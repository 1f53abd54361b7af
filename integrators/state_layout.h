#pragma once

#include <cstddef>
#include <vector>

#include "integrators/system.h"

namespace integrators {

// Where the parts of a system's state are in one vector: the chains in order,
// then the common state. With a range of chains, the same for a part of it.
class StateLayout {
 public:
  // All of it.
  explicit StateLayout(const System& system)
      : StateLayout(system, 0, system.num_chains(), true) {}

  // Some chains, and the common state if wanted.
  StateLayout(const System& system, int first_chain, int num_chains,
              bool has_common)
      : first_chain_(first_chain), has_common_(has_common) {
    std::size_t offset = 0;
    for (int k = first_chain; k < first_chain + num_chains; ++k) {
      offsets_.push_back(offset);
      offset += static_cast<std::size_t>(system.chain_size(k));
    }
    offsets_.push_back(offset);
    size_ = offset;
    if (has_common) size_ += static_cast<std::size_t>(system.common_size());
  }

  int first_chain() const { return first_chain_; }
  int num_chains() const { return static_cast<int>(offsets_.size()) - 1; }
  bool has_common() const { return has_common_; }
  std::size_t size() const { return size_; }
  // Of chain first_chain() + c.
  std::size_t chain_offset(int c) const {
    return offsets_[static_cast<std::size_t>(c)];
  }
  // Also the length of all chains together.
  std::size_t common_offset() const { return offsets_.back(); }
  std::size_t common_size() const { return size_ - common_offset(); }

 private:
  int first_chain_;
  bool has_common_;
  std::vector<std::size_t> offsets_;
  std::size_t size_;
};

}  // namespace integrators
