#include "bench/sync_bare.h"

#include <memory>
#include <string>

#include "bench/sync_operations.h"
#include "bench/sync_plan.h"
#include "macrotask/placement.h"

namespace bench {
namespace {

// Spinning against those one waits for is told, by the row of one construct;
// the others are left out.
void LeaveOutOverload(Variant* variant) {
  if (variant->num_tasks <= macrotask::NumProcessors()) return;
  variant->missing =
      "only spins: needs " + std::to_string(variant->num_tasks) + " processors";
}

template <typename SomeBarrier>
Variant BareBarrier(const SyncAxes& axes, const char* by, int num_tasks,
                    double work, Skew skew) {
  return {.family = SyncFamily::kBarrier,
          .construct = "barrier",
          .by = by,
          .num_tasks = num_tasks,
          .work = work,
          .skew = skew,
          .latency = LatencyKind::kLastInLastOut,
          .run = RunOn(MakePthreadTeam(num_tasks, axes.placement), [num_tasks] {
            return std::make_unique<BarrierOperation<SomeBarrier>>(num_tasks);
          })};
}

void AddBarriers(const SyncAxes& axes, std::vector<Variant>* variants) {
  ForEachPoint(axes, true, [&](int num_tasks, double work, Skew skew) {
    // Milliseconds a call: once is enough.
    const bool crowded = num_tasks > macrotask::NumProcessors();
    if (crowded && work > axes.works.front()) return;
    variants->push_back(BareBarrier<CentralCounter>(axes, "bare counter",
                                                    num_tasks, work, skew));
    if (num_tasks != 2) return;
    variants->push_back(BareBarrier<PairwiseFlags>(axes, "bare pairwise flags",
                                                   num_tasks, work, skew));
    LeaveOutOverload(&variants->back());
  });
}

void AddEvents(const SyncAxes& axes, std::vector<Variant>* variants) {
  ForEachPoint(axes, true, [&](int num_tasks, double work, Skew skew) {
    variants->push_back(
        {.family = SyncFamily::kEvent,
         .construct = "post to wait",
         .by = "bare flag",
         .num_tasks = num_tasks,
         .work = work,
         .skew = skew,
         .latency = LatencyKind::kFromFirstTask,
         .parts = 2,
         .run = RunOn(MakePthreadTeam(num_tasks, axes.placement), [num_tasks] {
           return std::make_unique<EventOperation<FlagEvent>>(num_tasks);
         })});
    LeaveOutOverload(&variants->back());
  });
}

void AddLocks(const SyncAxes& axes, std::vector<Variant>* variants) {
  const auto make = [](long work) {
    return std::make_unique<LockOperation<ExchangeLock>>(work);
  };
  const auto lock = std::make_shared<ExchangeLock>();
  const auto test = [lock] { (void)lock->Test(); };
  const Team alone = MakePthreadTeam(1, axes.placement);
  variants->push_back({.family = SyncFamily::kLock,
                       .construct = "lock + unlock, alone",
                       .by = "bare exchange",
                       .run = RunOn(alone, make)});
  variants->push_back(
      {.family = SyncFamily::kLock,
       .construct = "test and set",
       .by = "bare exchange",
       .run = RunOn(alone, [test] {
         return std::make_unique<SimpleOperation<decltype(test)>>(test);
       })});
  ForEachPoint(axes, false, [&](int num_tasks, double work, Skew) {
    variants->push_back(
        {.family = SyncFamily::kLock,
         .construct = "lock + unlock",
         .by = "bare exchange",
         .num_tasks = num_tasks,
         .work = work,
         .latency = LatencyKind::kHandOff,
         .serial = true,
         .run = RunOn(MakePthreadTeam(num_tasks, axes.placement), make)});
    LeaveOutOverload(&variants->back());
  });
}

}  // namespace

void AddBareAtomics(const SyncAxes& axes, std::vector<Variant>* variants) {
  if (axes.Wants(SyncFamily::kBarrier)) AddBarriers(axes, variants);
  if (axes.Wants(SyncFamily::kEvent)) AddEvents(axes, variants);
  if (axes.Wants(SyncFamily::kLock)) AddLocks(axes, variants);
}

}  // namespace bench
