#pragma once

namespace macrotask {

// Internal: where a logical processor finds what it keeps in shared objects: a
// number below kMost that no other one has as long as this lives, or kNone if
// there are that many already.
class LogicalSlot {
 public:
  static constexpr int kMost = 63;
  static constexpr int kNone = -1;

  LogicalSlot();
  ~LogicalSlot();
  LogicalSlot(const LogicalSlot&) = delete;
  LogicalSlot& operator=(const LogicalSlot&) = delete;

  int number() const { return number_; }

 private:
  const int number_;
};

}  // namespace macrotask
