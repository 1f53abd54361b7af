#include "bench/sync_loop.h"

#include <sys/resource.h>

#include <algorithm>
#include <limits>

namespace bench {
namespace {

// The clock costs no more than a few of the calls between two looks, and a loop
// ends soon after its limit.
constexpr long kLooks = 16;
constexpr long kCallsPerLookOfRace = 64;

double Seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) +
         static_cast<double>(time.tv_usec) * 1e-6;
}

}  // namespace

long LoopTiming::total_calls() const {
  long total = 0;
  for (const long n : calls) total += n;
  return total;
}

LoopEnd::LoopEnd(const LoopSpec& spec)
    : calls_per_look_(spec.race ? kCallsPerLookOfRace
                                : std::max(1l, spec.calls / kLooks)),
      race_(spec.race),
      deadline_(Ticks() +
                static_cast<std::uint64_t>(spec.limit * TicksPerSecond())) {
  last_->store(spec.calls, std::memory_order_relaxed);
}

long LoopEnd::FirstLook(int task) const {
  return task == 0 || race_ ? 1 : std::numeric_limits<long>::max();
}

long LoopEnd::Look(long call) {
  if (Ticks() >= deadline_ && call < last_->load(std::memory_order_relaxed)) {
    last_->store(call, std::memory_order_relaxed);
  }
  return call + std::min(call, calls_per_look_);
}

LoopTiming Combine(
    const std::vector<macrotask::CacheAligned<TaskTiming>>& tasks,
    bool from_first_start) {
  LoopTiming all;
  std::uint64_t start = tasks[0]->start, end = 0;
  for (const auto& task : tasks) {
    start = from_first_start ? std::min(start, task->start)
                             : std::max(start, task->start);
    end = std::max(end, task->end);
    all.cpu += task->cpu;
    all.calls.push_back(task->calls);
    all.switches += task->switches;
  }
  all.seconds = SecondsBetween(start, end);
  return all;
}

ThreadUsage UsageOfCaller() {
  rusage usage{};
  getrusage(RUSAGE_THREAD, &usage);
  return {Seconds(usage.ru_utime) + Seconds(usage.ru_stime), usage.ru_nivcsw};
}

}  // namespace bench
