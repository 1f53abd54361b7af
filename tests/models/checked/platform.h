#pragma once

// Relacy under the library: put in front of a source of the library by
// -include, while tests/models/checked stands before the root in the search for
// headers. The source then gets relacy's atomics, and from the headers in
// checked/macrotask relacy's mutex and condition variable, in place of the real
// ones. It is compiled as it stands.

// Everything standard that the sources include comes first: what follows are
// macros.
#include <dirent.h>
#include <sched.h>
#include <sys/types.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <source_location>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>
//
#include <relacy.hpp>

#undef assert
#undef calloc
#undef delete
#undef errno
#undef free
#undef malloc
#undef memory_order_acq_rel
#undef memory_order_acquire
#undef memory_order_consume
#undef memory_order_relaxed
#undef memory_order_release
#undef memory_order_seq_cst
#undef new
#undef realloc

#include "tests/models/checked/orders.h"

namespace macrotask::checked {

// std::atomic<T> on rl::atomic<T>. Every order goes through Order(), which may
// weaken it.
template <typename T>
class Atomic {
 public:
  using Where = std::source_location;

  Atomic(T value) : atomic_(value) {}
  Atomic(const Atomic&) = delete;
  Atomic& operator=(const Atomic&) = delete;

  T load(std::memory_order order = std::memory_order_seq_cst,
         Where where = Where::current()) const {
    return atomic_.load(Order(Step::kLoad, order, where), Info(where));
  }
  void store(T value, std::memory_order order = std::memory_order_seq_cst,
             Where where = Where::current()) {
    atomic_.store(value, Order(Step::kStore, order, where), Info(where));
  }
  T exchange(T value, std::memory_order order, Where where = Where::current()) {
    return atomic_.exchange(value, Order(Step::kChange, order, where),
                            Info(where));
  }
  T fetch_add(T value, std::memory_order order,
              Where where = Where::current()) {
    return atomic_.fetch_add(value, Order(Step::kChange, order, where),
                             Info(where));
  }
  T fetch_or(T value, std::memory_order order, Where where = Where::current()) {
    return atomic_.fetch_or(value, Order(Step::kChange, order, where),
                            Info(where));
  }
  T fetch_and(T value, std::memory_order order,
              Where where = Where::current()) {
    return atomic_.fetch_and(value, Order(Step::kChange, order, where),
                             Info(where));
  }
  bool compare_exchange_weak(T& expected, T value, std::memory_order order,
                             std::memory_order failure,
                             Where where = Where::current()) {
    const Orders orders = OrdersOf(order, failure, where);
    return atomic_.compare_exchange_weak(expected, value, orders.of_change,
                                         Info(where), orders.of_failure,
                                         Info(where));
  }
  bool compare_exchange_weak(T& expected, T value, std::memory_order order,
                             Where where = Where::current()) {
    return compare_exchange_weak(expected, value, order, OfFailure(order),
                                 where);
  }
  bool compare_exchange_strong(T& expected, T value, std::memory_order order,
                               std::memory_order failure,
                               Where where = Where::current()) {
    const Orders orders = OrdersOf(order, failure, where);
    return atomic_.compare_exchange_strong(expected, value, orders.of_change,
                                           Info(where), orders.of_failure,
                                           Info(where));
  }
  bool compare_exchange_strong(
      T& expected, T value, std::memory_order order = std::memory_order_seq_cst,
      Where where = Where::current()) {
    return compare_exchange_strong(expected, value, order, OfFailure(order),
                                   where);
  }

 private:
  static rl::debug_info Info(const Where& where) {
    return {where.function_name(), where.file_name(), where.line()};
  }

  struct Orders {
    rl::memory_order of_change;
    rl::memory_order of_failure;
  };
  // Relacy knows no failure that is stronger than the change, and would loop.
  static Orders OrdersOf(std::memory_order change, std::memory_order failure,
                         const Where& where) {
    const Orders orders = {Order(Step::kChange, change, where),
                           Order(Step::kFailure, failure, where)};
    const bool is_stronger = orders.of_change != rl::mo_seq_cst &&
                             orders.of_failure == rl::mo_seq_cst;
    return is_stronger ? Orders{orders.of_change, rl::mo_acquire} : orders;
  }

  rl::atomic<T> atomic_;
};

// Of the program around the source, whose orders are never weakened.
template <typename T>
using UncheckedAtomic = rl::atomic<T>;

// A switch that is set before the tasks start and lives outside of them.
template <>
class Atomic<bool> : public std::atomic<bool> {
 public:
  using std::atomic<bool>::atomic;
};

}  // namespace macrotask::checked

// The sources say std::atomic.
namespace std {
template <typename T>
using checked_atomic = macrotask::checked::Atomic<T>;
}
#define atomic checked_atomic
