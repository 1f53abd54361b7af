#pragma once

// In place of macrotask/asymmetric_fence.h: both fences are those of C++, which
// together promise the same. Two light ones promise too much here: that is for
// spin, whose model has a store buffer.

#include <source_location>

#include "tests/models/checked/orders.h"

namespace macrotask {

// Chosen by the program under check.
inline bool has_heavy_fence = true;

inline constexpr std::uint32_t kLightFencesPerHeavyOne = 2;

inline void Fence(const std::source_location& where) {
  rl::atomic_thread_fence(
      checked::Order(checked::Step::kFence, std::memory_order_seq_cst, where),
      {where.function_name(), where.file_name(), where.line()});
}

inline void LightFence(
    std::source_location where = std::source_location::current()) {
  Fence(where);
}

inline void HeavyFence(
    std::source_location where = std::source_location::current()) {
  Fence(where);
}

}  // namespace macrotask
