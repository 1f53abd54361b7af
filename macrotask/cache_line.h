#pragma once

#include <cstddef>

namespace macrotask {

// Distance in bytes at which two variables no longer share a cache line on
// x86-64. A constant, because std::hardware_destructive_interference_size
// depends on -mtune and would make the layout differ between translation units.
inline constexpr std::size_t kCacheLine = 64;

// A T that shares its cache line with nothing else, so that an array of them
// gives every task a slot which no neighbour slows down.
//
//   std::vector<CacheAligned<double>> slots(num_tasks);
//   RunTasks(num_tasks, [&](int task) { slots[task].value = Work(task); });
template <typename T>
struct alignas(kCacheLine) CacheAligned {
  T value{};

  T& operator*() { return value; }
  const T& operator*() const { return value; }
  T* operator->() { return &value; }
  const T* operator->() const { return &value; }
};

static_assert(sizeof(CacheAligned<char>) == kCacheLine);
static_assert(alignof(CacheAligned<char>) == kCacheLine);

}  // namespace macrotask
