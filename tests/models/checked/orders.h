#pragma once

// The memory orders that the checked source asks for, and one of them weakened.

#include <array>
#include <atomic>
#include <cstddef>
#include <optional>
#include <source_location>
#include <string>

namespace macrotask::checked {

enum class Step { kLoad, kStore, kChange, kFailure, kFence };

// One order in the source made weaker.
struct Weakening {
  std::source_location where;
  Step step;
  std::memory_order from;
  std::memory_order to;
};

// All weakenings that are possible at what has been executed so far.
struct Weakenings {
  std::array<Weakening, 64> all;
  std::size_t size = 0;
};
inline Weakenings met;
inline std::optional<Weakening> in_force;

// "Sync() change acq_rel -> acquire".
std::string ToString(const Weakening& weakening);

// The order of a compare-exchange that fails, if it has none of its own.
std::memory_order OfFailure(std::memory_order order);

// The order in which `step` is done: `order`, or what `in_force` makes of it.
rl::memory_order Order(Step step, std::memory_order order,
                       const std::source_location& where);

}  // namespace macrotask::checked
