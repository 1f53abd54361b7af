#include "bench/sync_delay.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace bench {

double MeasureDelayRate() {
  using Clock = std::chrono::steady_clock;
  constexpr int kTries = 20;
  constexpr long kSteps = 200'000;
  double best = 0;
  for (int i = 0; i < kTries; ++i) {
    const Clock::time_point start = Clock::now();
    Delay(kSteps);
    const std::chrono::duration<double> seconds = Clock::now() - start;
    best = std::max(best, static_cast<double>(kSteps) / seconds.count());
  }
  return best;
}

long DelaySteps(double microseconds, double rate) {
  return std::lround(microseconds * 1e-6 * rate);
}

}  // namespace bench
