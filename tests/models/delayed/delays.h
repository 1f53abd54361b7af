#pragma once

// Random delays between the steps of the library: put in front of each of its
// sources by -include. Every operation on a std::atomic, and every call of a
// mutex or a condition variable, is then preceded by a delay, most of the time
// none, now and then one long enough for others to do a lot. It is compiled as
// it stands otherwise.

// Everything standard that the sources include comes first: what follows are
// macros.
#include <cpuid.h>
#include <cxxabi.h>
#include <dirent.h>
#include <dlfcn.h>
#include <limits.h>
#include <linux/membarrier.h>
#include <pthread.h>
#include <sched.h>
#include <sys/syscall.h>
#include <sys/types.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cctype>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <cinttypes>
#include <compare>
#include <cstdarg>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <deque>
#include <exception>
#include <filesystem>
#include <functional>
#include <iostream>
#include <iterator>
#include <limits>
#include <map>
#include <memory>
#include <new>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <thread>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace macrotask::delayed {

// From which every pthread's delays follow.
inline constinit std::atomic<std::uint64_t> seed{1};

// xorshift64*, good enough for chance and quick enough to change little.
inline std::uint64_t Random() {
  static constinit thread_local std::uint64_t state = 0;
  if (state == 0) state = seed.fetch_add(0x9e3779b97f4a7c15) | 1;
  state ^= state >> 12;
  state ^= state << 25;
  state ^= state >> 27;
  return state * 0x2545f4914f6cdd1d;
}

// Of 1024 delays 64 are a few hundred nanoseconds, 16 give up the processor and
// 4 sleep, 60 us or more.
inline void Delay() {
  const std::uint64_t chance = Random() >> 54;
  if (chance >= 84) return;
  if (chance < 4) {
    const timespec some_time = {0, 10'000};
    nanosleep(&some_time, nullptr);
  } else if (chance < 20) {
    sched_yield();
  } else {
    for (std::uint64_t i = Random() % 256; i > 0; --i) asm volatile("");
  }
}

template <typename T>
class Atomic : public std::atomic<T> {
  using Base = std::atomic<T>;
  static constexpr auto kSeqCst = std::memory_order_seq_cst;

 public:
  using Base::Base;
  using Base::operator=;

  T load(std::memory_order order = kSeqCst) const noexcept {
    Delay();
    return Base::load(order);
  }
  operator T() const noexcept { return load(); }
  void store(T value, std::memory_order order = kSeqCst) noexcept {
    Delay();
    Base::store(value, order);
  }
  T exchange(T value, std::memory_order order = kSeqCst) noexcept {
    Delay();
    return Base::exchange(value, order);
  }
  template <typename... Orders>
  bool compare_exchange_weak(T& expected, T value, Orders... orders) noexcept {
    Delay();
    return Base::compare_exchange_weak(expected, value, orders...);
  }
  template <typename... Orders>
  bool compare_exchange_strong(T& expected, T value,
                               Orders... orders) noexcept {
    Delay();
    return Base::compare_exchange_strong(expected, value, orders...);
  }
  template <typename Operand>
  T fetch_add(Operand value, std::memory_order order = kSeqCst) noexcept {
    Delay();
    return Base::fetch_add(value, order);
  }
  template <typename Operand>
  T fetch_sub(Operand value, std::memory_order order = kSeqCst) noexcept {
    Delay();
    return Base::fetch_sub(value, order);
  }
  T fetch_and(T value, std::memory_order order = kSeqCst) noexcept {
    Delay();
    return Base::fetch_and(value, order);
  }
  T fetch_or(T value, std::memory_order order = kSeqCst) noexcept {
    Delay();
    return Base::fetch_or(value, order);
  }
};

}  // namespace macrotask::delayed

namespace std {
template <typename T>
using delayed_atomic = macrotask::delayed::Atomic<T>;
}
#define atomic delayed_atomic

#define pthread_mutex_lock(mutex) \
  (macrotask::delayed::Delay(), pthread_mutex_lock(mutex))
#define pthread_mutex_unlock(mutex) \
  (macrotask::delayed::Delay(), pthread_mutex_unlock(mutex))
#define pthread_cond_wait(condition, mutex) \
  (macrotask::delayed::Delay(), pthread_cond_wait(condition, mutex))
#define pthread_cond_broadcast(condition) \
  (macrotask::delayed::Delay(), pthread_cond_broadcast(condition))
#define syscall(...) (macrotask::delayed::Delay(), syscall(__VA_ARGS__))
