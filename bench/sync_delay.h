#pragma once

namespace bench {

// Busy work: so many steps of arithmetic, each of which needs the one before.
// Touches no memory. About a nanosecond a step.
inline void Delay(long steps) {
  unsigned long x = 1;
  for (long i = 0; i < steps; ++i) {
    x = x * 6364136223846793005ul + 1442695040888963407ul;
    asm volatile("" : "+r"(x));
  }
}

// Steps of Delay() a second, as measured now: the best of several tries.
double MeasureDelayRate();

// Steps that take `microseconds` at `rate` steps a second, rounded.
long DelaySteps(double microseconds, double rate);

}  // namespace bench
