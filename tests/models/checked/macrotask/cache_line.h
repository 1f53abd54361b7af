#pragma once

// In place of macrotask/cache_line.h: relacy's memory is aligned to 16.

#include <cstddef>

namespace macrotask {

inline constexpr std::size_t kCacheLine = 16;

}  // namespace macrotask
