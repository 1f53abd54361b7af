#pragma once

// In place of macrotask/load.h.

namespace macrotask {

inline bool MoreTasksThanProcessors() { return false; }

}  // namespace macrotask
