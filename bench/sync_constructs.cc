// The library's own constructs.

#include <memory>
#include <string>

#include "bench/sync_operations.h"
#include "bench/sync_plan.h"
#include "macrotask/barrier.h"
#include "macrotask/event.h"
#include "macrotask/lock.h"
#include "macrotask/placement.h"
#include "macrotask/task.h"
#include "macrotask/worker_pool.h"

namespace bench {
namespace {

using macrotask::BarrierAlgorithm;
using macrotask::WaitKind;
using macrotask::WaitPolicy;

class Barsync {
 public:
  Barsync(int num_tasks, WaitPolicy wait) : barrier_(num_tasks, wait) {}
  void Sync(int) { barrier_.Sync(); }

 private:
  macrotask::Barrier barrier_;
};

class MemberBarsync {
 public:
  MemberBarsync(int num_tasks, WaitPolicy wait, BarrierAlgorithm algorithm)
      : barrier_(num_tasks, wait, algorithm) {}
  void Sync(int task) { barrier_.Sync(task); }

 private:
  macrotask::Barrier barrier_;
};

// Task 0 starts the others and waits for them.
class StartOperation {
 public:
  StartOperation(int num_tasks, WaitPolicy wait, SyncPlacement placement)
      : num_tasks_(num_tasks),
        wait_(wait),
        pinned_(placement == SyncPlacement::kPinned),
        placement_(num_tasks) {}

  template <typename SomeMarks>
  void Call(int, SomeMarks& marks) {
    std::vector<std::unique_ptr<macrotask::Task>> tasks;
    tasks.reserve(static_cast<std::size_t>(num_tasks_));
    marks.In(0);
    for (int task = 1; task < num_tasks_; ++task) {
      const int processor =
          pinned_ ? placement_.processor(task) : macrotask::kAnyProcessor;
      tasks.push_back(std::make_unique<macrotask::Task>(
          [&marks, task] { marks.Out(task); },
          macrotask::TaskOptions{.wait = wait_, .processor = processor}));
    }
    for (const auto& task : tasks) task->Wait();
    marks.Release(0);
  }

 private:
  const int num_tasks_;
  const WaitPolicy wait_;
  const bool pinned_;
  const macrotask::Placement placement_;
};

// The same after `prepare()`, which is not timed.
template <typename Prepare>
class ColdStartOperation : public StartOperation {
 public:
  ColdStartOperation(const StartOperation& start, Prepare prepare)
      : StartOperation(start), prepare_(prepare) {}

  template <typename SomeMarks>
  void Call(int task, SomeMarks& marks) {
    prepare_();
    StartOperation::Call(task, marks);
  }

 private:
  Prepare prepare_;
};

template <typename Operation, typename... Args>
auto Making(const Args&... args) {
  return [=] { return std::make_unique<Operation>(args...); };
}

// The algorithms that need to know who is who are made for tasks that hold their
// processors.
bool IsForMembers(int num_tasks, WaitPolicy wait) {
  return num_tasks <= macrotask::NumProcessors() &&
         (wait.kind == WaitKind::kSpin || wait.kind == WaitKind::kHold);
}

void AddBarriers(const SyncAxes& axes, WaitPolicy wait,
                 std::vector<Variant>* variants) {
  ForEachPoint(axes, true, [&](int num_tasks, double work, Skew skew) {
    const Team team = MakeTaskTeam(num_tasks, wait, axes.placement);
    const Variant anonymous = {
        .family = SyncFamily::kBarrier,
        .construct = "BARSYNC",
        .by = std::string(Name(wait.kind)),
        .num_tasks = num_tasks,
        .work = work,
        .skew = skew,
        .latency = LatencyKind::kLastInLastOut,
        .run = RunOn(team, Making<BarrierOperation<Barsync>>(num_tasks, wait))};
    variants->push_back(anonymous);
    if (!IsForMembers(num_tasks, wait)) return;
    for (const auto algorithm :
         {BarrierAlgorithm::kCounter, BarrierAlgorithm::kDissemination,
          BarrierAlgorithm::kTree}) {
      Variant variant = anonymous;
      variant.construct = "BARSYNC, " + std::string(Name(algorithm));
      variant.run = RunOn(team, Making<BarrierOperation<MemberBarsync>>(
                                    num_tasks, wait, algorithm));
      variants->push_back(variant);
    }
  });
}

void AddEvents(const SyncAxes& axes, WaitPolicy wait,
               std::vector<Variant>* variants) {
  ForEachPoint(axes, true, [&](int num_tasks, double work, Skew skew) {
    variants->push_back(
        {.family = SyncFamily::kEvent,
         .construct = "EVPOST to EVWAIT",
         .by = std::string(Name(wait.kind)),
         .num_tasks = num_tasks,
         .work = work,
         .skew = skew,
         .latency = LatencyKind::kFromFirstTask,
         .parts = 2,
         .run =
             RunOn(MakeTaskTeam(num_tasks, wait, axes.placement),
                   Making<EventOperation<macrotask::Event>>(num_tasks, wait))});
  });
}

// `function` must be copyable.
template <typename Function>
void AddSimple(const SyncAxes& axes, SyncFamily family,
               const std::string& construct, WaitPolicy wait, Function function,
               std::vector<Variant>* variants) {
  variants->push_back(
      {.family = family,
       .construct = construct,
       .by = std::string(Name(wait.kind)),
       .run = RunOn(MakeTaskTeam(1, wait, axes.placement),
                    Making<SimpleOperation<Function>>(function))});
}

void AddUncontended(const SyncAxes& axes, WaitPolicy wait,
                    std::vector<Variant>* variants) {
  const auto lock = std::make_shared<macrotask::Lock>(wait);
  const auto event = std::make_shared<macrotask::Event>(wait);
  const auto set = std::make_shared<macrotask::Lock>(wait);
  set->On();
  if (axes.Wants(SyncFamily::kEvent)) {
    const auto post = [event] {
      event->Post();
      event->Clear();
    };
    AddSimple(axes, SyncFamily::kEvent, "EVPOST + EVCLEAR, nobody waits", wait,
              post, variants);
  }
  if (!axes.Wants(SyncFamily::kLock)) return;
  const auto pair = [lock] {
    lock->On();
    lock->Off();
  };
  const auto test = [set] { (void)set->Test(); };
  const auto test_pair = [lock] {
    (void)lock->Test();
    lock->Off();
  };
  AddSimple(axes, SyncFamily::kLock, "LOCKON + LOCKOFF, alone", wait, pair,
            variants);
  AddSimple(axes, SyncFamily::kLock, "LOCKTEST, set", wait, test, variants);
  AddSimple(axes, SyncFamily::kLock, "LOCKTEST + LOCKOFF", wait, test_pair,
            variants);
}

void AddContendedLocks(const SyncAxes& axes, WaitPolicy wait,
                       std::vector<Variant>* variants) {
  ForEachPoint(axes, false, [&](int num_tasks, double work, Skew) {
    const auto make = [wait](long steps) {
      return std::make_unique<LockOperation<macrotask::Lock>>(steps, wait);
    };
    variants->push_back(
        {.family = SyncFamily::kLock,
         .construct = "LOCKON + LOCKOFF",
         .by = std::string(Name(wait.kind)),
         .num_tasks = num_tasks,
         .work = work,
         .latency = LatencyKind::kHandOff,
         .serial = true,
         .run = RunOn(MakeTaskTeam(num_tasks, wait, axes.placement), make)});
  });
}

template <typename Prepare>
Variant ColdStart(const SyncAxes& axes, const Variant& warm, WaitPolicy wait,
                  const char* how, Prepare prepare) {
  Variant cold = warm;
  cold.construct = std::string("TSKSTART + TSKWAIT, ") + how;
  cold.timing = Timing::kWhole;
  const StartOperation start(warm.num_tasks, wait, axes.placement);
  cold.run = RunOn(MakeTaskTeam(1, wait, axes.placement),
                   Making<ColdStartOperation<Prepare>>(start, prepare));
  return cold;
}

void AddStarts(const SyncAxes& axes, WaitPolicy wait,
               std::vector<Variant>* variants) {
  // Longer than any idle pthread is held.
  const auto rest = 2 * std::max(axes.hold_time, macrotask::kDefaultHoldTime);
  const auto fall_asleep = [rest] {
    const auto end = std::chrono::steady_clock::now() + rest;
    while (std::chrono::steady_clock::now() < end) Delay(100);
  };
  const auto end_pthreads = [] { macrotask::WorkerPool::TheOne().JoinIdle(); };
  for (const int num_tasks : axes.num_tasks) {
    if (num_tasks < 2) continue;
    const StartOperation start(num_tasks, wait, axes.placement);
    Variant warm = {.family = SyncFamily::kTask,
                    .construct = "TSKSTART + TSKWAIT, one after the other",
                    .by = std::string(Name(wait.kind)),
                    .num_tasks = num_tasks,
                    .latency = LatencyKind::kFromFirstTask,
                    .run = RunOn(MakeTaskTeam(1, wait, axes.placement),
                                 Making<StartOperation>(start))};
    variants->push_back(warm);
    variants->push_back(
        ColdStart(axes, warm, wait, "after a rest", fall_asleep));
    variants->push_back(
        ColdStart(axes, warm, wait, "new pthreads", end_pthreads));
  }
}

}  // namespace

void AddConstructs(const SyncAxes& axes, std::vector<Variant>* variants) {
  for (const WaitPolicy& wait : axes.Policies()) {
    if (axes.Wants(SyncFamily::kBarrier)) AddBarriers(axes, wait, variants);
    if (axes.Wants(SyncFamily::kEvent)) AddEvents(axes, wait, variants);
    AddUncontended(axes, wait, variants);
    if (axes.Wants(SyncFamily::kLock)) AddContendedLocks(axes, wait, variants);
    if (axes.Wants(SyncFamily::kTask)) AddStarts(axes, wait, variants);
  }
}

}  // namespace bench
