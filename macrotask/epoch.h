#pragma once

#include <atomic>
#include <cstdint>

#include "macrotask/cache_line.h"
#include "macrotask/mutex.h"
#include "macrotask/wait_policy.h"
#include "macrotask/waited_object.h"

namespace macrotask {

// Internal: a number that only grows and tasks that wait for it to grow.
// Events, the queue of a lock, the end of a task and the wait of an idle
// pthread are made of it.
//
// Use: any task may call anything. A task that AwaitPast() has released may
// destroy the epoch at once if it was the only one to wait and only one
// advance was made; otherwise the epoch must outlive every call.
// Memory ordering: an advance releases, Read() and AwaitPast() acquire: what a
// task wrote before it advanced the epoch is visible to whoever sees the new
// number, or a later one.
// Cost: one atomic read-modify-write an advance; a system call only if somebody
// sleeps, which the word itself tells.
//
//   Epoch ready;                                // 0
//   flag = 1; ready.Advance();                  // one task
//   ready.AwaitPast(0, WaitPolicy::Hold());     // another: flag is 1
class alignas(kCacheLine) Epoch {
 public:
  Epoch() = default;
  Epoch(const Epoch&) = delete;
  Epoch& operator=(const Epoch&) = delete;

  std::uint64_t Read() const;

  // Adds one and wakes everybody.
  void Advance();

  // The same, to `epoch` at once, which spares the look at the old one: where
  // processors take a line that they read, that look is a second transfer of
  // it (from 55 to 78 ns, measured with two tasks that advance one each).
  // Requires: only one task at a time ever advances the epoch; `epoch` >
  // Read().
  void AdvanceTo(std::uint64_t epoch);

  // As Advance(), but only from an even (odd) number, from where it leads to an odd
  // (even) one. One atomic step.
  void AdvanceIfEven() { AdvanceIf(0); }
  void AdvanceIfOdd() { AdvanceIf(1); }

  // Returns when the epoch is greater than `seen`, at once if it is already.
  // `what` is what the caller says it waits for.
  // Requires: `seen` <= Read(), one must have seen it. (An advance to `seen`
  // itself would use up the bit by which a sleeper calls for the next one.)
  void AwaitPast(std::uint64_t seen, const WaitPolicy& policy,
                 const WaitedObject& what = {});

 private:
  void AdvanceIf(std::uint64_t parity);
  void WakeSleepers(std::uint64_t epoch);
  void SleepPast(std::uint64_t seen);

  // epoch << 1 | somebody_sleeps. 63 bits: at one advance a nanosecond they
  // last for three centuries, where 31 would wrap round in seconds and leave
  // `released_`, which is written only for sleepers, any distance behind.
  std::atomic<std::uint64_t> word_{0};
  Mutex mutex_;
  Condition wake_;
  std::uint64_t released_ =
      0;  // guarded by mutex_: last epoch told to sleepers
};

}  // namespace macrotask
