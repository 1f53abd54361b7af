// What others offer for the same purpose.

#include <pthread.h>

#include <barrier>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <string>

#include "bench/sync_openmp.h"
#include "bench/sync_operations.h"
#include "bench/sync_plan.h"
#include "macrotask/check.h"

namespace bench {
namespace {

class PthreadBarrier {
 public:
  explicit PthreadBarrier(int num_tasks) {
    macrotask::CheckPthread(
        pthread_barrier_init(&barrier_, nullptr,
                             static_cast<unsigned>(num_tasks)),
        "pthread_barrier_init");
  }
  ~PthreadBarrier() { pthread_barrier_destroy(&barrier_); }
  PthreadBarrier(const PthreadBarrier&) = delete;
  PthreadBarrier& operator=(const PthreadBarrier&) = delete;

  void Sync(int) { pthread_barrier_wait(&barrier_); }

 private:
  pthread_barrier_t barrier_;
};

class StdBarrier {
 public:
  explicit StdBarrier(int num_tasks) : barrier_(num_tasks) {}
  void Sync(int) { barrier_.arrive_and_wait(); }

 private:
  std::barrier<> barrier_;
};

class ConditionBarrier {
 public:
  explicit ConditionBarrier(int num_tasks) : num_tasks_(num_tasks) {}

  void Sync(int) {
    std::unique_lock<std::mutex> guard(mutex_);
    const unsigned long phase = phase_;
    if (++num_there_ == num_tasks_) {
      num_there_ = 0;
      ++phase_;
      all_there_.notify_all();
      return;
    }
    all_there_.wait(guard, [&] { return phase_ != phase; });
  }

 private:
  const int num_tasks_;
  std::mutex mutex_;
  std::condition_variable all_there_;
  int num_there_ = 0;        // guarded by mutex_
  unsigned long phase_ = 0;  // likewise
};

class OpenMpBarrier {
 public:
  explicit OpenMpBarrier(const std::shared_ptr<OpenMpRuntime>& runtime)
      : runtime_(runtime) {}
  void Sync(int) { runtime_->Barrier(); }

 private:
  const std::shared_ptr<OpenMpRuntime> runtime_;
};

class ConditionEvent {
 public:
  void Post() {
    const std::lock_guard<std::mutex> guard(mutex_);
    posted_ = true;
    changed_.notify_all();
  }
  void Wait() {
    std::unique_lock<std::mutex> guard(mutex_);
    changed_.wait(guard, [this] { return posted_; });
  }
  void Clear() {
    const std::lock_guard<std::mutex> guard(mutex_);
    posted_ = false;
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  bool posted_ = false;  // guarded by mutex_
};

class PthreadMutex {
 public:
  void On() { mutex_.lock(); }
  void Off() { mutex_.unlock(); }

 private:
  std::mutex mutex_;
};

// Task 0 creates the others and joins them.
class CreateOperation {
 public:
  explicit CreateOperation(int num_tasks) : num_tasks_(num_tasks) {}

  template <typename SomeMarks>
  void Call(int, SomeMarks& marks) {
    std::vector<Started<SomeMarks>> started;
    started.reserve(static_cast<std::size_t>(num_tasks_));
    marks.In(0);
    for (int task = 1; task < num_tasks_; ++task) {
      started.push_back({&marks, task, {}});
      macrotask::CheckPthread(pthread_create(&started.back().pthread, nullptr,
                                             &Body<SomeMarks>, &started.back()),
                              "pthread_create");
    }
    for (const auto& one : started) pthread_join(one.pthread, nullptr);
    marks.Release(0);
  }

 private:
  template <typename SomeMarks>
  struct Started {
    SomeMarks* marks;
    int task;
    pthread_t pthread;
  };

  template <typename SomeMarks>
  static void* Body(void* started) {
    const auto* const self = static_cast<Started<SomeMarks>*>(started);
    self->marks->Out(self->task);
    return nullptr;
  }

  const int num_tasks_;
};

template <typename SomeBarrier>
void AddBarrier(const SyncAxes& axes, const std::string& by,
                std::vector<Variant>* variants) {
  ForEachPoint(axes, true, [&](int num_tasks, double work, Skew skew) {
    const auto make = [num_tasks] {
      return std::make_unique<BarrierOperation<SomeBarrier>>(num_tasks);
    };
    variants->push_back(
        {.family = SyncFamily::kBarrier,
         .construct = "barrier",
         .by = by,
         .num_tasks = num_tasks,
         .work = work,
         .skew = skew,
         .latency = LatencyKind::kLastInLastOut,
         .run = RunOn(MakePthreadTeam(num_tasks, axes.placement), make)});
  });
}

void AddOpenMp(const SyncAxes& axes, const std::string& name,
               std::vector<Variant>* variants) {
  const auto runtime = OpenMpRuntime::Open(name);
  ForEachPoint(axes, true, [&](int num_tasks, double work, Skew skew) {
    Variant variant = {.family = SyncFamily::kBarrier,
                       .construct = "barrier",
                       .by = name,
                       .num_tasks = num_tasks,
                       .work = work,
                       .skew = skew,
                       .latency = LatencyKind::kLastInLastOut};
    if (runtime == nullptr) {
      variant.missing = "not installed";
    } else {
      variant.run =
          RunOn(runtime->MakeTeam(num_tasks, axes.placement), [runtime] {
            return std::make_unique<BarrierOperation<OpenMpBarrier>>(runtime);
          });
    }
    variants->push_back(variant);
  });
}

void AddEvents(const SyncAxes& axes, std::vector<Variant>* variants) {
  ForEachPoint(axes, true, [&](int num_tasks, double work, Skew skew) {
    const auto make = [num_tasks] {
      return std::make_unique<EventOperation<ConditionEvent>>(num_tasks);
    };
    variants->push_back(
        {.family = SyncFamily::kEvent,
         .construct = "post to wait",
         .by = "mutex + condition variable",
         .num_tasks = num_tasks,
         .work = work,
         .skew = skew,
         .latency = LatencyKind::kFromFirstTask,
         .parts = 2,
         .run = RunOn(MakePthreadTeam(num_tasks, axes.placement), make)});
  });
}

void AddLocks(const SyncAxes& axes, std::vector<Variant>* variants) {
  const auto make = [](long work) {
    return std::make_unique<LockOperation<PthreadMutex>>(work);
  };
  variants->push_back({.family = SyncFamily::kLock,
                       .construct = "lock + unlock, alone",
                       .by = "pthread_mutex_t",
                       .run = RunOn(MakePthreadTeam(1, axes.placement), make)});
  ForEachPoint(axes, false, [&](int num_tasks, double work, Skew) {
    variants->push_back(
        {.family = SyncFamily::kLock,
         .construct = "lock + unlock",
         .by = "pthread_mutex_t",
         .num_tasks = num_tasks,
         .work = work,
         .latency = LatencyKind::kHandOff,
         .serial = true,
         .run = RunOn(MakePthreadTeam(num_tasks, axes.placement), make)});
  });
}

void AddCreation(const SyncAxes& axes, std::vector<Variant>* variants) {
  for (const int num_tasks : axes.num_tasks) {
    if (num_tasks < 2) continue;
    variants->push_back(
        {.family = SyncFamily::kTask,
         .construct = "pthread_create + pthread_join",
         .by = "pthreads",
         .num_tasks = num_tasks,
         .latency = LatencyKind::kFromFirstTask,
         .timing = Timing::kWhole,
         // The caller must not be pinned: what it creates would be so, too.
         .run = RunOn(MakePthreadTeam(1, SyncPlacement::kFree), [num_tasks] {
           return std::make_unique<CreateOperation>(num_tasks);
         })});
  }
}

}  // namespace

void AddPeers(const SyncAxes& axes, std::vector<Variant>* variants) {
  if (axes.Wants(SyncFamily::kBarrier)) {
    AddBarrier<PthreadBarrier>(axes, "pthread_barrier_t", variants);
    AddBarrier<StdBarrier>(axes, "std::barrier", variants);
    AddBarrier<ConditionBarrier>(axes, "mutex + condition variable", variants);
    for (const char* name : kOpenMpRuntimes) AddOpenMp(axes, name, variants);
  }
  if (axes.Wants(SyncFamily::kEvent)) AddEvents(axes, variants);
  if (axes.Wants(SyncFamily::kLock)) AddLocks(axes, variants);
  if (axes.Wants(SyncFamily::kTask)) AddCreation(axes, variants);
}

}  // namespace bench
