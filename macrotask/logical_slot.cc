#include "macrotask/logical_slot.h"

#include <atomic>
#include <bit>
#include <cstdint>

namespace macrotask {
namespace {

std::atomic<std::uint64_t> slots_in_use{0};

std::uint64_t BitOf(int slot) { return std::uint64_t{1} << slot; }

int TakeSlot() {
  std::uint64_t in_use = slots_in_use.load(std::memory_order_relaxed);
  for (;;) {
    const int slot = std::countr_one(in_use);
    if (slot >= LogicalSlot::kMost) return LogicalSlot::kNone;
    // Acquire: partner of the release in ~LogicalSlot(): what the last one with
    // this number left in the barriers.
    if (slots_in_use.compare_exchange_weak(in_use, in_use | BitOf(slot),
                                           std::memory_order_acquire,
                                           std::memory_order_relaxed)) {
      return slot;
    }
  }
}

}  // namespace

LogicalSlot::LogicalSlot() : number_(TakeSlot()) {}

LogicalSlot::~LogicalSlot() {
  if (number_ == kNone) return;
  // Release: partner of the acquire in TakeSlot().
  slots_in_use.fetch_and(~BitOf(number_), std::memory_order_release);
}

}  // namespace macrotask
