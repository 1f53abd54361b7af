#pragma once

#include <cstdint>

#include "macrotask/clock.h"

namespace bench {

// The clock of all timestamps: macrotask's, in ticks.
inline std::uint64_t Ticks() { return macrotask::ReadStamp().clock; }

// Ticks a second, measured once against the system's monotonic clock.
double TicksPerSecond();

// `ticks` may be negative: the difference of two tasks' clocks.
inline double TicksToSeconds(std::int64_t ticks) {
  return static_cast<double>(ticks) / TicksPerSecond();
}
inline double SecondsBetween(std::uint64_t from, std::uint64_t to) {
  return TicksToSeconds(static_cast<std::int64_t>(to - from));
}

// How far the clocks of two processors may be apart. A message sent there at
// tick s arrives at tick r > s if they agree, and so does the answer.
struct ClockAgreement {
  double there;  // s, the shortest way there as the two clocks see it
  double back;   // s, the shortest way back

  // Neither arrives before it was sent.
  bool agree() const { return there > 0 && back > 0; }
};

// Measured by two pinned tasks. Requires: two processors.
ClockAgreement CompareClocks();

}  // namespace bench
