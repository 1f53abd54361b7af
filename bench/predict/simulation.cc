#include "bench/predict/simulation.h"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <optional>
#include <queue>
#include <random>
#include <stdexcept>
#include <utility>

#include "bench/predict/simulated_objects.h"
#include "bench/predict/simulated_processors.h"
#include "bench/predict/simulated_task.h"

namespace bench::predict {
namespace {

std::size_t At(int index) { return static_cast<std::size_t>(index); }

struct Happening {
  double time;
  std::uint64_t number;  // what is decided first comes first
  int task;
  enum Kind { kReady, kGoesOn } kind;

  bool operator>(const Happening& other) const {
    return time != other.time ? time > other.time : number > other.number;
  }
};

class Simulation {
 public:
  Simulation(const Program& program, const SimulationOptions& options)
      : program_(program),
        options_(options),
        processors_(options.processors, options.placement, program.num_tasks()),
        objects_(program) {
    std::mt19937_64 seeds(options.seed);
    for (const TaskProgram& task : program.tasks) {
      tasks_.emplace_back(task, seeds());
    }
  }

  SimulationResult Run() {
    for (int t = 0; t < program_.num_tasks(); ++t) {
      if (!program_.tasks[At(t)].started) Begin(t, 0);
    }
    while (!agenda_.empty()) {
      const Happening next = agenda_.top();
      agenda_.pop();
      now_ = next.time;
      if (next.kind == Happening::kReady) {
        Give(processors_.Take(next.task));
      } else {
        GoOn(next.task);
      }
    }
    return Result();
  }

 private:
  using Task = SimulatedTask;
  using Barrier = SimulatedBarrier;
  using Event = SimulatedEvent;
  using Lock = SimulatedLock;

  bool is_crowded() const { return num_live_ > processors_.number(); }

  void Plan(double time, int task, Happening::Kind kind) {
    agenda_.push({time, num_planned_++, task, kind});
  }

  void Begin(int t, double time) {
    ++num_live_;
    Task& task = tasks_[At(t)];
    task.times.absent = time;
    task.ready_since = time;
    Plan(time, t, Happening::kReady);
  }

  // Whoever is given a processor goes on.
  void Give(const std::optional<SimulatedProcessors::Turn>& turn) {
    if (!turn) return;
    Task& task = tasks_[At(turn->task)];
    task.times.queue += now_ - task.ready_since;
    const double seconds = turn->follows ? options_.wait.turn : 0;
    task.times.sync += seconds;
    Plan(now_ + seconds, turn->task, Happening::kGoesOn);
  }

  // --- Steps ----------------------------------------------------------------

  // `t` has a processor: does what takes no time, and begins what does.
  void GoOn(int t) {
    Task& task = tasks_[At(t)];
    while (!task.cursor.at_end()) {
      const Step step = task.cursor.step();
      if (step.kind != StepKind::kCompute) {
        task.cursor.Next();
        const bool holds = !Call(t, step);
        if (holds) return;
        if (busy_until_ > now_) {
          KeepBusy(t);
          return;
        }
        continue;
      }
      const double seconds = task.Draw(step, options_.spreads);
      task.cursor.Next();
      if (seconds <= 0) continue;
      task.times.compute += seconds;
      Plan(now_ + seconds, t, Happening::kGoesOn);
      return;
    }
    End(t);
  }

  // `t` goes on when what it called is over.
  void KeepBusy(int t) {
    tasks_[At(t)].times.sync += busy_until_ - now_;
    Plan(busy_until_, t, Happening::kGoesOn);
  }

  void End(int t) {
    Task& task = tasks_[At(t)];
    task.complete = true;
    busy_until_ = now_;
    for (const int joiner : std::exchange(task.joiners, {})) {
      Release(joiner, t, options_.wait.event);
    }
    if (busy_until_ > now_) {
      KeepBusy(t);  // and comes back here, with nobody left to wake
      return;
    }
    task.times.absent -= now_;  // the rest when the end of the run is known
    end_ = std::max(end_, now_);
    --num_live_;
    ++num_complete_;
    Give(processors_.Leave(t));
  }

  // --- Calls ----------------------------------------------------------------

  // Makes a call of `t`. Returns whether it goes on, from busy_until_; so do the
  // calls that may wait.
  bool Call(int t, const Step& step) {
    const std::size_t index = At(step.object);
    busy_until_ = now_;
    switch (step.kind) {
      case StepKind::kBarrier:
        return Arrive(t, &objects_.barriers[index]);
      case StepKind::kPost:
        Post(t, &objects_.events[index]);
        return true;
      case StepKind::kClear:
        Clear(&objects_.events[index]);
        return true;
      case StepKind::kWait:
        return Pass(t, &objects_.events[index]);
      case StepKind::kLock:
        return Acquire(t, &objects_.locks[index]);
      case StepKind::kUnlock:
        Unlock(t, &objects_.locks[index]);
        return true;
      case StepKind::kStart:
        Begin(step.object, now_ + options_.wait.start);
        return true;
      case StepKind::kJoin:
        return Join(t, &tasks_[index]);
      case StepKind::kCompute:
        break;
    }
    return true;
  }

  // Adds `t` to `waiting`. Returns false: it does not go on.
  template <typename Waiting>
  bool Wait(int t, Waiting* waiting) {
    waiting->push_back(t);
    tasks_[At(t)].waits_since = now_;
    Give(processors_.Leave(t));
    return false;
  }

  bool Arrive(int t, Barrier* barrier) {
    const int num_waiting = static_cast<int>(barrier->waiting.size());
    if (num_waiting + 1 < barrier->num_tasks) return Wait(t, &barrier->waiting);
    const double latency = options_.wait.barrier.Seconds(barrier->num_tasks);
    has_woken_ = false;
    for (const int waiter : barrier->waiting) Release(waiter, t, latency);
    barrier->waiting.clear();
    // Whoever has woken others has paid for it; else it leaves with them.
    if (!is_crowded() && !has_woken_) busy_until_ += latency;
    return true;
  }

  void Post(int t, Event* event) {
    // Whoever knows that it is posted learns nothing from another post.
    if (!event->posted) event->posted_at = now_;
    event->posted = true;
    busy_until_ += options_.wait.post;
    for (const int waiter : event->waiting) {
      Release(waiter, t, options_.wait.event);
    }
    event->waiting.clear();
  }

  void Clear(Event* event) {
    event->posted = false;
    busy_until_ += options_.wait.post;
  }

  // One that was posted just now is not known here yet.
  bool Pass(int t, Event* event) {
    if (!event->posted) return Wait(t, &event->waiting);
    if (is_crowded()) return true;
    busy_until_ = std::max(busy_until_, event->posted_at + options_.wait.event);
    return true;
  }

  bool Acquire(int t, Lock* lock) {
    if (lock->taken) return Wait(t, &lock->waiting);
    lock->taken = true;
    return true;
  }

  void Unlock(int t, Lock* lock) {
    if (lock->waiting.empty()) {
      lock->taken = false;
      return;
    }
    Release(lock->waiting.front(), t, options_.wait.lock);
    lock->waiting.pop_front();
  }

  bool Join(int t, Task* task) {
    return task->complete || Wait(t, &task->joiners);
  }

  // A call of `by` now ends the wait of `t`.
  void Release(int t, int by, double latency) {
    const WaitCost& cost = options_.wait;
    Task& task = tasks_[At(t)];
    const double waited = now_ - task.waits_since;
    task.times.imbalance += waited;
    if (is_crowded()) {
      latency = processors_.AreNeighbours(t, by) ? 0 : cost.shared_wake;
    } else if (waited > cost.sleeps_after) {
      latency = cost.wake;
      has_woken_ = true;
      busy_until_ = std::max(busy_until_, now_ + cost.waker);
    }
    task.times.sync += latency;
    task.ready_since = now_ + latency;
    Plan(task.ready_since, t, Happening::kReady);
  }

  // --- The end --------------------------------------------------------------

  SimulationResult Result() {
    if (num_complete_ < program_.num_tasks()) {
      throw std::runtime_error(WhoWaits(tasks_, objects_));
    }
    SimulationResult result;
    result.seconds = end_;
    for (Task& task : tasks_) {
      task.times.absent += end_;
      result.tasks.push_back(task.times);
    }
    return result;
  }

  const Program& program_;
  const SimulationOptions& options_;
  std::vector<Task> tasks_;
  SimulatedProcessors processors_;
  SimulatedObjects objects_;
  std::priority_queue<Happening, std::vector<Happening>, std::greater<>>
      agenda_;
  std::uint64_t num_planned_ = 0;
  double now_ = 0;
  double end_ = 0;
  double busy_until_ = 0;   // that call of the current task is over
  bool has_woken_ = false;  // the current arrival at a barrier: sleepers
  int num_live_ = 0;
  int num_complete_ = 0;
};

}  // namespace

SimulationResult Simulate(const Program& program,
                          const SimulationOptions& options) {
  return Simulation(program, options).Run();
}

}  // namespace bench::predict
