#pragma once

// In place of macrotask/logical_wait.h: no task is logical.

namespace macrotask {

inline constexpr void* processor_of_caller = nullptr;

inline void GiveWay() {}

}  // namespace macrotask
