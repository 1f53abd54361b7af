#pragma once

#include <optional>

#include "bench/predict/program.h"
#include "macrotask/trace.h"

// What a program leaves in its history trace to say what it computes.

namespace bench::predict {

inline constexpr int kMarkAction = macrotask::kFirstUserAction + 2;

// From here on, until its next record, the calling task computes `block`.
inline void Mark(Block block) {
  macrotask::RecordUser(kMarkAction, static_cast<std::uint64_t>(block));
}

// The block of a mark; nothing if the record is none.
inline std::optional<Block> MarkOf(const macrotask::TraceRecord& record) {
  if (static_cast<int>(record.action) != kMarkAction) return {};
  if (record.data >= static_cast<std::uint64_t>(kNumBlocks)) return {};
  return static_cast<Block>(record.data);
}

}  // namespace bench::predict
