// What no construct can undercut on this machine.

#include <linux/futex.h>
#include <sched.h>
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

#include <atomic>
#include <climits>
#include <memory>
#include <string>

#include "bench/sync_bare.h"
#include "bench/sync_operations.h"
#include "bench/sync_plan.h"
#include "macrotask/placement.h"

namespace bench {
namespace {

class RoundTripOperation {
 public:
  template <typename SomeMarks>
  void Call(int task, SomeMarks&) {
    round_trip_.Call(task);
  }

 private:
  RoundTrip round_trip_;
};

// Task 1 sleeps on a futex, task 0 wakes it.
class FutexOperation {
 public:
  explicit FutexOperation(long rest) : rest_(rest) {}

  template <typename SomeMarks>
  void Call(int task, SomeMarks& marks) {
    if (task == 0) {
      SpinOn([&] { return asleep_->load() == word_->load() + 1; });
      Delay(rest_);  // It says so before it sleeps.
      word_->fetch_add(1);
      marks.In(0);
      Futex(FUTEX_WAKE_PRIVATE, INT_MAX);
      marks.Release(0);
      return;
    }
    const int seen = word_->load();
    asleep_->store(seen + 1);
    while (word_->load() == seen) Futex(FUTEX_WAIT_PRIVATE, seen);
    marks.Out(1);
  }

 private:
  void Futex(int operation, int value) {
    static_assert(sizeof(std::atomic<int>) == sizeof(int));
    syscall(SYS_futex, &*word_, operation, value, nullptr, nullptr, 0);
  }

  const long rest_;  // steps of Delay()
  macrotask::CacheAligned<std::atomic<int>> word_, asleep_;
};

template <typename Function>
void AddAlone(const SyncAxes& axes, const char* what, Function function,
              std::vector<Variant>* variants) {
  variants->push_back(
      {.family = SyncFamily::kLimit,
       .construct = what,
       .by = "hardware",
       .run = RunOn(MakePthreadTeam(1, axes.placement), [function] {
         return std::make_unique<SimpleOperation<Function>>(function);
       })});
}

template <typename Make>
void AddPair(const SyncAxes& axes, const char* what, const char* by, Make make,
             std::vector<Variant>* variants) {
  Variant pair = {.family = SyncFamily::kLimit,
                  .construct = what,
                  .by = by,
                  .num_tasks = 2,
                  .run = RunOn(MakePthreadTeam(2, axes.placement), make)};
  if (macrotask::NumProcessors() < 2) pair.missing = "needs 2 processors";
  variants->push_back(pair);
}

}  // namespace

void AddLimits(const SyncAxes& axes, std::vector<Variant>* variants) {
  AddPair(
      axes, "cache line there and back", "hardware",
      [] { return std::make_unique<RoundTripOperation>(); }, variants);
  const long rest = DelaySteps(50, MeasureDelayRate());
  AddPair(
      axes, "futex wake to running", "Linux",
      [rest] { return std::make_unique<FutexOperation>(rest); }, variants);
  variants->back().timing = Timing::kWhole;
  variants->back().latency = LatencyKind::kFromFirstTask;

  const auto word = std::make_shared<std::atomic<long>>(0);
  AddAlone(
      axes, "atomic read-modify-write, alone",
      [word] { word->fetch_add(1, std::memory_order_acq_rel); }, variants);
  AddAlone(
      axes, "timestamp", [] { (void)Ticks(); }, variants);
  AddAlone(
      axes, "clock_gettime",
      [] {
        timespec now;
        clock_gettime(CLOCK_MONOTONIC, &now);
      },
      variants);
  AddAlone(
      axes, "pause", [] { macrotask::Pause(); }, variants);
  AddAlone(
      axes, "sched_yield, nobody else", [] { sched_yield(); }, variants);
}

}  // namespace bench
