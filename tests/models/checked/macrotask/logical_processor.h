#pragma once

// In place of macrotask/logical_processor.h and of logical_slot.h, which it
// includes: a task of relacy is a processor.
// Its tasks have no stacks: one that waits at a barrier is kept in a list, and
// the program under check gives it its turns.

#include <cstdint>
#include <utility>

#include "macrotask/waited_object.h"

namespace macrotask {

class LogicalBarrier;

class LogicalSlot {
 public:
  static constexpr int kMost = 3;
  static constexpr int kNone = -1;
};

class LogicalProcessor {
 public:
  explicit LogicalProcessor(int slot) : slot_(slot) {}

  int slot() const { return slot_; }
  void FlushLater(LogicalBarrier*) { must_flush_ = true; }
  void IsFlushed(LogicalBarrier*) { must_flush_ = false; }
  bool must_flush() const { return must_flush_; }

  // Returns at once, unlike the real one.
  void WaitAt(LogicalBarrier&, std::uint64_t end_of_phase,
              const WaitedObject&) {
    end_of_wait_ = end_of_phase;
  }
  // The end of the phase for which the task that has just arrived waits; 0 if
  // it does not.
  std::uint64_t TakeWait() { return std::exchange(end_of_wait_, 0); }

 private:
  const int slot_;
  bool must_flush_ = false;
  std::uint64_t end_of_wait_ = 0;
};

}  // namespace macrotask
