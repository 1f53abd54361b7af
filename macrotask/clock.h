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
inline constexpr unsigned kCpuMask = 0xfff;  // in what RDTSCP, RDPID give

inline bool HasRdtscp() {
  unsigned a, b, c, d = 0;
  constexpr unsigned kRdtscp = 1u << 27;
  return __get_cpuid(0x80000001, &a, &b, &c, &d) != 0 && (d & kRdtscp) != 0;
}

inline bool HasRdpid() {
  unsigned a, b, c = 0, d;
  constexpr unsigned kRdpid = 1u << 22;
  return HasRdtscp() && __get_cpuid_count(7, 0, &a, &b, &c, &d) != 0 &&
         (c & kRdpid) != 0;
}

inline Stamp ReadStamp() {
  static const bool has_rdtscp = HasRdtscp();
  if (!has_rdtscp) {
    return {__builtin_ia32_rdtsc(), static_cast<std::uint16_t>(sched_getcpu())};
  }
  unsigned node_and_cpu;
  const std::uint64_t clock = __builtin_ia32_rdtscp(&node_and_cpu);
  return {clock, static_cast<std::uint16_t>(node_and_cpu & kCpuMask)};
}

// Internal: the same in half the time where the processor has RDPID. What comes
// before it need not be done yet: the clock may be earlier, by as much as the
// processor works ahead, some ten nanoseconds.
inline const bool has_rdpid = HasRdpid();  // no is right, too, until it is set

inline Stamp ReadStampAhead() {
  if (!has_rdpid) return ReadStamp();
  std::uint64_t node_and_cpu;
  asm volatile("rdpid %0" : "=r"(node_and_cpu));
  return {__builtin_ia32_rdtsc(),
          static_cast<std::uint16_t>(node_and_cpu & kCpuMask)};
}

#else
inline Stamp ReadStamp() {
  timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return {static_cast<std::uint64_t>(now.tv_sec) * 1'000'000'000u +
              static_cast<std::uint64_t>(now.tv_nsec),
          static_cast<std::uint16_t>(sched_getcpu())};
}

inline Stamp ReadStampAhead() { return ReadStamp(); }
#endif

}  // namespace macrotask
