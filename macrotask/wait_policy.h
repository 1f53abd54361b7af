#pragma once

#include <chrono>
#include <optional>
#include <string_view>

namespace macrotask {

// How a task waits for a barrier, an event, a lock or another task.
enum class WaitKind {
  kAuto,   // kHold; RunTasks() with more tasks than processors: kLogical
  kBlock,  // sleeps at once: pthread_barrier_t, or mutex and condition variable
  kSpin,   // never sleeps; yields if there are more tasks than processors
  kHold,   // holds its processor for a while, spinning, then sleeps
  kLogical,  // the next task of the same processor goes on, in user space
};

// How long a `hold` wait spins before it sleeps. To fall asleep and to be woken
// costs 20 to 30 us (measured on a 2-processor KVM guest, Zen 3 class): to spin
// for less throws that away for waits which were about to end, to spin for much
// longer burns more than it can save. 50 us is twice that cost.
inline constexpr std::chrono::nanoseconds kDefaultHoldTime =
    std::chrono::microseconds(50);

// How a task waits: the kind and, for kHold, the time. A plain value, fixed
// when a barrier, event, lock or task is made. Objects of different policies
// may be used side by side by the same tasks; a logical task waits in its own
// way at objects of every policy. (A barrier of kBlock is for pthreads alone or
// for logical tasks alone: a pthread_barrier_t knows of pthreads only.)
//
// Cray name: HOLDTIME, a keyword of TSKTUNE, is `hold_time`.
// Use: with more live tasks than processors kHold sleeps at once (at a barrier
// all but the last to arrive on a processor) and kSpin yields the processor
// between two looks, so that every policy makes progress with any number of
// tasks. Live tasks are the initial one and those of this
// library; other threads of the program are not counted.
// Cost: every bench row of a synchronization says which policy it is of.
//
// kLogical is for RunTasks(), whose tasks then take turns on NumProcessors()
// pthreads, and for the objects that these use; elsewhere it is kHold. Such
// tasks wait a hundred times faster than pthreads that share processors, and
// obey two rules. First, nobody interrupts a task: one that asks a variable of
// its own again and again for what a neighbour has to do, instead of waiting
// here, waits for ever, and one that sleeps in the kernel lets its neighbours
// sleep. Second, what belongs to a pthread (thread_local variables, its signal
// mask, a mutex held across a wait) belongs to all tasks of a processor.
//
//   RunTasks(num_tasks, body);  // whatever suits the number of tasks
//   Barrier faithful(num_tasks, WaitPolicy::Block());
//   Barrier dedicated(num_tasks, WaitPolicy::Spin());
//   Event patient(WaitPolicy::Hold(std::chrono::milliseconds(1)));
struct WaitPolicy {
  WaitKind kind = WaitKind::kAuto;
  std::chrono::nanoseconds hold_time = kDefaultHoldTime;  // of kHold, kAuto

  static constexpr WaitPolicy Block() {
    return {WaitKind::kBlock, kDefaultHoldTime};
  }
  static constexpr WaitPolicy Spin() {
    return {WaitKind::kSpin, kDefaultHoldTime};
  }
  static constexpr WaitPolicy Hold(
      std::chrono::nanoseconds hold_time = kDefaultHoldTime) {
    return {WaitKind::kHold, hold_time};
  }

  static constexpr WaitPolicy Logical() {
    return {WaitKind::kLogical, kDefaultHoldTime};
  }

  // The same, with the kind that kAuto stands for in a RunTasks() of so many.
  WaitPolicy For(int num_tasks) const;

  friend bool operator==(const WaitPolicy&, const WaitPolicy&) = default;
};

// Returns "auto", "block", "spin", "hold" or "logical".
std::string_view Name(WaitKind kind);

// Returns the kind that Name() calls `name`, or nothing if there is none.
std::optional<WaitKind> ParseWaitKind(std::string_view name);

}  // namespace macrotask
