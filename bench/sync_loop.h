#pragma once

#include <atomic>
#include <vector>

#include "bench/sync_clock.h"
#include "bench/sync_delay.h"
#include "bench/sync_team.h"
#include "macrotask/cache_line.h"

namespace bench {

// What every task of a team does `calls` times: busy work, then a construct.
struct LoopSpec {
  long calls = 1;
  long work = 0;      // steps of Delay() before each call
  long late = 0;      // further ones of task 0
  double limit = 10;  // s, after which the tasks stop, whatever `calls` says
  bool race = false;  // tasks that never wait for each other's calls: any of
                      // them may call for the end, and not only task 0
  // Timed from the first start instead of the last: where tasks run before all
  // are there, because they share processors or do not wait for each other.
  bool from_first_start = false;
};

struct LoopTiming {
  double seconds = 0;       // start to last end
  double cpu = 0;           // s, all tasks together
  std::vector<long> calls;  // by task
  long switches = 0;        // involuntary ones, of all tasks

  long total_calls() const;
};

// Tells the tasks of a loop when to stop. Where calls pair (a barrier), all
// must stop after the same one: task 0 names it before it makes it, so that
// everybody who has completed it knows.
class LoopEnd {
 public:
  explicit LoopEnd(const LoopSpec& spec);

  // The number of the first call (1, 2, ...) of `task` before which it must
  // Look(), and after that of the next one. At first they double, so that a
  // loop of slow calls ends soon, too.
  long FirstLook(int task) const;
  long Look(long call);
  // After it.
  bool Passed(long call) const {
    return call >= last_->load(std::memory_order_relaxed);
  }

 private:
  const long calls_per_look_;
  const bool race_;
  const std::uint64_t deadline_;  // ticks
  // Relaxed, because the calls themselves order it where they pair.
  macrotask::CacheAligned<std::atomic<long>> last_;
};

struct TaskTiming {
  std::uint64_t start = 0, end = 0;  // ticks
  long calls = 0;
  double cpu = 0;
  long switches = 0;
};
LoopTiming Combine(
    const std::vector<macrotask::CacheAligned<TaskTiming>>& tasks,
    bool from_first_start);

// What the calling pthread has used so far.
struct ThreadUsage {
  double cpu;
  long switches;
};
ThreadUsage UsageOfCaller();

// Calls op.Call(task, marks) in a loop in every task of the team.
template <typename Op, typename SomeMarks>
LoopTiming RunLoop(Op& op, const Team& team, const LoopSpec& spec,
                   SomeMarks& marks) {
  StartLine line(team);
  LoopEnd end(spec);
  std::vector<macrotask::CacheAligned<TaskTiming>> timings(
      static_cast<std::size_t>(team.num_tasks));
  team.run([&](int task) {
    TaskTiming timing;
    const long work = spec.work + (task == 0 ? spec.late : 0);
    line.Wait();
    const ThreadUsage before = UsageOfCaller();
    long next_look = end.FirstLook(task);
    timing.start = Ticks();
    do {
      Delay(work);
      if (++timing.calls == next_look) next_look = end.Look(timing.calls);
      op.Call(task, marks);
    } while (!end.Passed(timing.calls));
    timing.end = Ticks();
    const ThreadUsage after = UsageOfCaller();
    timing.cpu = after.cpu - before.cpu;
    timing.switches = after.switches - before.switches;
    *timings[static_cast<std::size_t>(task)] = timing;
  });
  return Combine(timings, spec.from_first_start);
}

}  // namespace bench
