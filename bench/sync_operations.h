#pragma once

#include <atomic>
#include <cstddef>
#include <utility>
#include <vector>

#include "bench/sync_delay.h"
#include "macrotask/cache_line.h"

// What a task does in one call of a measured loop, whoever made the construct.

namespace bench {

// A function of no arguments, for one task or for tasks that do not meet.
template <typename Function>
class SimpleOperation {
 public:
  explicit SimpleOperation(Function function)
      : function_(std::move(function)) {}

  template <typename SomeMarks>
  void Call(int, SomeMarks&) {
    function_();
    asm volatile("" ::: "memory");
  }

 private:
  Function function_;
};

// `SomeBarrier` has Sync(task).
template <typename SomeBarrier>
class BarrierOperation {
 public:
  template <typename... Args>
  explicit BarrierOperation(const Args&... args) : barrier_(args...) {}

  template <typename SomeMarks>
  void Call(int task, SomeMarks& marks) {
    marks.In(task);
    barrier_.Sync(task);
    marks.Out(task);
  }

 private:
  SomeBarrier barrier_;
};

// Task 0 posts, all others wait, and the last of them posts back: there and
// back. `SomeEvent` has Post(), Wait() and Clear().
template <typename SomeEvent>
class EventOperation {
 public:
  template <typename... Args>
  explicit EventOperation(int num_tasks, const Args&... args)
      : there_{SomeEvent(args...), SomeEvent(args...)},
        back_(args...),
        calls_(static_cast<std::size_t>(num_tasks)),
        num_waiters_(num_tasks - 1) {}

  template <typename SomeMarks>
  void Call(int task, SomeMarks& marks) {
    // Two in turn: a waiter that is back here first must not take the post for
    // the next one.
    SomeEvent& there = there_[(*calls_[static_cast<std::size_t>(task)])++ % 2];
    if (task == 0) {
      marks.In(0);
      there.Post();
      back_.Wait();
      back_.Clear();
      return;
    }
    there.Wait();
    marks.Out(task);
    if (!IsLast()) return;
    there.Clear();
    back_.Post();
  }

 private:
  bool IsLast() {
    return num_waiters_ == 1 ||
           (num_through_->fetch_add(1, std::memory_order_acq_rel) + 1) %
                   num_waiters_ ==
               0;
  }

  SomeEvent there_[2];
  SomeEvent back_;
  std::vector<macrotask::CacheAligned<unsigned long>> calls_;
  const int num_waiters_;
  macrotask::CacheAligned<std::atomic<long>> num_through_;
};

// `SomeLock` has On() and Off(); `work` is done inside.
template <typename SomeLock>
class LockOperation {
 public:
  template <typename... Args>
  explicit LockOperation(long work, const Args&... args)
      : work_(work), lock_(args...) {}

  template <typename SomeMarks>
  void Call(int task, SomeMarks& marks) {
    marks.In(task);
    lock_.On();
    marks.Out(task);
    Delay(work_);
    marks.Release(task);
    lock_.Off();
  }

 private:
  const long work_;
  SomeLock lock_;
};

}  // namespace bench
