#pragma once

#include <sched.h>

#include <cstdint>

#if defined(__x86_64__)
#include <cpuid.h>
#else
#include <ctime>
#endif

namespace macrotask {

// Internal: what the history trace writes beside every entry.
struct Stamp {
  std::uint64_t clock;  // ticks, monotonic and the same on all processors
  std::uint16_t cpu;
};

// Internal: the cheapest monotonic clock that there is, with the processor that
// read it. On x86-64 one instruction, RDTSCP, of which the system makes sure
// that it gives the processor as well.
#if defined(__x86_64__)
inline bool HasRdtscp() {
  unsigned a, b, c, d = 0;
  constexpr unsigned kRdtscp = 1u << 27;
  return __get_cpuid(0x80000001, &a, &b, &c, &d) != 0 && (d & kRdtscp) != 0;
}

inline Stamp ReadStamp() {
  static const bool has_rdtscp = HasRdtscp();
  if (!has_rdtscp) {
    return {__builtin_ia32_rdtsc(), static_cast<std::uint16_t>(sched_getcpu())};
  }
  unsigned node_and_cpu;
  const std::uint64_t clock = __builtin_ia32_rdtscp(&node_and_cpu);
  constexpr unsigned kCpuMask = 0xfff;
  return {clock, static_cast<std::uint16_t>(node_and_cpu & kCpuMask)};
}
#else
inline Stamp ReadStamp() {
  timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return {static_cast<std::uint64_t>(now.tv_sec) * 1'000'000'000u +
              static_cast<std::uint64_t>(now.tv_nsec),
          static_cast<std::uint16_t>(sched_getcpu())};
}
#endif

}  // namespace macrotask
