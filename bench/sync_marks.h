#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "bench/sync_clock.h"
#include "macrotask/cache_line.h"

namespace bench {

// The ticks at which one task did something, call by call.
struct TaskMarks {
  std::vector<std::uint64_t> in;       // before it arrived, posted, asked
  std::vector<std::uint64_t> out;      // after it was let go, got it, began
  std::vector<std::uint64_t> release;  // before it gave a lock away; after a
                                       // construct that is timed as a whole
};

// What the latencies of a loop are computed from. Every task writes its own.
class Marks {
 public:
  Marks(int num_tasks, long num_calls)
      : tasks_(static_cast<std::size_t>(num_tasks)) {
    for (auto& task : tasks_) {
      for (auto* marks : {&task->in, &task->out, &task->release}) {
        marks->reserve(static_cast<std::size_t>(num_calls));
      }
    }
  }

  void In(int task) { Of(task).in.push_back(Ticks()); }
  void Out(int task) { Of(task).out.push_back(Ticks()); }
  void Release(int task) { Of(task).release.push_back(Ticks()); }

  std::vector<TaskMarks> Take() const {
    std::vector<TaskMarks> taken;
    for (const auto& task : tasks_) taken.push_back(*task);
    return taken;
  }

 private:
  TaskMarks& Of(int task) { return *tasks_[static_cast<std::size_t>(task)]; }

  std::vector<macrotask::CacheAligned<TaskMarks>> tasks_;
};

// The same in a loop that is timed as a whole: nothing.
struct NoMarks {
  void In(int) {}
  void Out(int) {}
  void Release(int) {}
};

}  // namespace bench
