#include "bench/predict/simulation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <deque>
#include <functional>
#include <queue>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>

namespace bench::predict {
namespace {

constexpr int kNobody = -1;

std::size_t At(int index) { return static_cast<std::size_t>(index); }

// Follows the steps of a task.
class Cursor {
 public:
  explicit Cursor(const TaskProgram& task) : task_(&task) { Settle(); }

  bool at_end() const { return part_ == 3; }
  const Step& step() const { return (*steps())[index_]; }
  void Next() {
    ++index_;
    Settle();
  }

 private:
  const std::vector<Step>* steps() const {
    return part_ == 0 ? &task_->head : part_ == 1 ? &task_->body : &task_->tail;
  }
  // Goes on to the next part, or the next body, where one is through.
  void Settle() {
    while (part_ < 3 && (index_ == steps()->size() || NoBodyIsLeft())) {
      const bool again = part_ == 1 && !NoBodyIsLeft() &&
                         ++turn_ < task_->num_bodies && index_ > 0;
      if (!again) ++part_;
      index_ = 0;
    }
  }
  bool NoBodyIsLeft() const { return part_ == 1 && turn_ >= task_->num_bodies; }

  const TaskProgram* task_;
  int part_ = 0;  // head, body, tail, nothing
  long turn_ = 0;
  std::size_t index_ = 0;
};

// The value of a spread that the share `u` of all do not exceed.
double Quantile(const Spread& spread, double u) {
  const double place = u * static_cast<double>(spread.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  if (below + 1 >= spread.size()) return spread.back();
  const double weight = place - static_cast<double>(below);
  return spread[below] + weight * (spread[below + 1] - spread[below]);
}

struct Task {
  Task(const TaskProgram& program, std::uint64_t seed)
      : cursor(program), random(seed) {}

  Cursor cursor;
  std::mt19937_64 random;  // its own, so that nobody's order matters to it
  TaskTimes times;
  double begin = 0;
  double waits_since = 0;
  double ready_since = 0;
  int processor = kNobody;  // has it, had it last, or is at home there
  bool complete = false;
  std::vector<int> joiners;
};

struct Processor {
  int task = kNobody;  // that has it
  int last = kNobody;  // that had it last
  std::deque<int> queue;
};

struct Barrier {
  std::vector<int> waiting;
};
struct Event {
  bool posted = false;
  double posted_at = 0;
  std::vector<int> waiting;
};
struct Lock {
  bool taken = false;
  std::deque<int> waiting;
};

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
        processors_(At(options.processors)),
        barriers_(program.barriers.size()),
        events_(At(program.num_events)),
        locks_(At(program.num_locks)) {
    std::mt19937_64 seeds(options.seed);
    const int n = program.num_tasks();
    for (int t = 0; t < n; ++t) {
      tasks_.emplace_back(program.tasks[At(t)], seeds());
      // Neighbours together, as many or one more on each.
      const long used = std::min<long>(n, options.processors);
      tasks_.back().processor = static_cast<int>(t * used / n);
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
        TakeProcessor(next.task);
      } else {
        GoOn(next.task);
      }
    }
    return Result();
  }

 private:
  bool is_crowded() const { return num_live_ > options_.processors; }

  void Plan(double time, int task, Happening::Kind kind) {
    agenda_.push({time, num_planned_++, task, kind});
  }

  void Begin(int t, double time) {
    ++num_live_;
    Task& task = tasks_[At(t)];
    task.begin = time;
    task.times.absent = time;
    task.ready_since = time;
    Plan(time, t, Happening::kReady);
  }

  // --- Processors -----------------------------------------------------------

  // `t` is ready: it gets a processor, or queues for one.
  void TakeProcessor(int t) {
    Task& task = tasks_[At(t)];
    if (options_.placement == TaskPlacement::kFree &&
        processors_[At(task.processor)].task != kNobody) {
      const auto idle = std::find_if(
          processors_.begin(), processors_.end(),
          [](const Processor& other) { return other.task == kNobody; });
      if (idle == processors_.end()) {
        free_queue_.push_back(t);
        return;
      }
      task.processor = static_cast<int>(idle - processors_.begin());
    }
    Processor& processor = processors_[At(task.processor)];
    if (processor.task == kNobody) {
      Dispatch(t, &processor);
    } else {
      processor.queue.push_back(t);
    }
  }

  void Dispatch(int t, Processor* processor) {
    Task& task = tasks_[At(t)];
    task.times.queue += now_ - task.ready_since;
    const bool follows = processor->last != kNobody && processor->last != t;
    const double turn = follows ? options_.wait.turn : 0;
    task.times.sync += turn;
    processor->task = processor->last = t;
    Plan(now_ + turn, t, Happening::kGoesOn);
  }

  // `t` waits or has ended: the next one has its processor.
  void LeaveProcessor(int t) {
    const int index = tasks_[At(t)].processor;
    Processor& processor = processors_[At(index)];
    processor.task = kNobody;
    std::deque<int>& queue = options_.placement == TaskPlacement::kFree
                                 ? free_queue_
                                 : processor.queue;
    if (queue.empty()) return;
    const int next = queue.front();
    queue.pop_front();
    tasks_[At(next)].processor = index;
    Dispatch(next, &processor);
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
      const double seconds = Draw(step, &task);
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

  double Draw(const Step& step, Task* task) const {
    return Vary(step.block, step.seconds, task) +
           Vary(Block::kOther, step.busy, task);
  }

  double Vary(Block block, double seconds, Task* task) const {
    const Spread& spread = options_.spreads[static_cast<std::size_t>(block)];
    if (spread.empty() || seconds == 0) return seconds;
    // 53 bits, as a double has them: the same everywhere.
    const double u = static_cast<double>(task->random() >> 11) * 0x1p-53;
    return seconds * Quantile(spread, u);
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
    LeaveProcessor(t);
  }

  // Makes a call of `t`. Returns whether it goes on, from busy_until_.
  bool Call(int t, const Step& step) {
    busy_until_ = now_;
    switch (step.kind) {
      case StepKind::kBarrier:
        return Arrive(t, step.object);
      case StepKind::kPost:
        Post(t, &events_[At(step.object)]);
        return true;
      case StepKind::kClear:
        events_[At(step.object)].posted = false;
        busy_until_ += options_.wait.post;
        return true;
      case StepKind::kWait:
        if (events_[At(step.object)].posted) {
          Pass(events_[At(step.object)]);
          return true;
        }
        events_[At(step.object)].waiting.push_back(t);
        break;
      case StepKind::kLock:
        if (!locks_[At(step.object)].taken) {
          locks_[At(step.object)].taken = true;
          return true;
        }
        locks_[At(step.object)].waiting.push_back(t);
        break;
      case StepKind::kUnlock:
        Unlock(t, &locks_[At(step.object)]);
        return true;
      case StepKind::kStart:
        Begin(step.object, now_ + options_.wait.start);
        return true;
      case StepKind::kJoin:
        if (tasks_[At(step.object)].complete) return true;
        tasks_[At(step.object)].joiners.push_back(t);
        break;
      case StepKind::kCompute:
        break;
    }
    Wait(t);
    return false;
  }

  void Wait(int t) {
    tasks_[At(t)].waits_since = now_;
    LeaveProcessor(t);
  }

  // Returns whether `t` goes on at once: in a barrier of its own.
  bool Arrive(int t, int index) {
    Barrier& barrier = barriers_[At(index)];
    const int num_tasks = program_.barriers[At(index)];
    if (static_cast<int>(barrier.waiting.size()) + 1 < num_tasks) {
      barrier.waiting.push_back(t);
      Wait(t);
      return false;
    }
    const double latency = options_.wait.barrier.Seconds(num_tasks);
    has_woken_ = false;
    for (const int waiter : barrier.waiting) Release(waiter, t, latency);
    barrier.waiting.clear();
    // Whoever has woken others has paid for it; else it leaves with them.
    if (!is_crowded() && !has_woken_) busy_until_ += latency;
    return true;
  }

  void Post(int t, Event* event) {
    event->posted = true;
    event->posted_at = now_;
    busy_until_ += options_.wait.post;
    for (const int waiter : event->waiting) {
      Release(waiter, t, options_.wait.event);
    }
    event->waiting.clear();
  }

  // The event is posted: the call goes on when that is known here.
  void Pass(const Event& event) {
    if (is_crowded()) return;
    busy_until_ = std::max(busy_until_, event.posted_at + options_.wait.event);
  }

  void Unlock(int t, Lock* lock) {
    if (lock->waiting.empty()) {
      lock->taken = false;
      return;
    }
    Release(lock->waiting.front(), t, options_.wait.lock);
    lock->waiting.pop_front();
  }

  // A call of `by` now ends the wait of `t`.
  void Release(int t, int by, double latency) {
    const WaitCost& cost = options_.wait;
    Task& task = tasks_[At(t)];
    const double waited = now_ - task.waits_since;
    task.times.imbalance += waited;
    if (is_crowded()) {
      const bool neighbours = task.processor == tasks_[At(by)].processor &&
                              options_.placement == TaskPlacement::kPinned;
      latency = neighbours ? 0 : cost.shared_wake;
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
      throw std::runtime_error(WhoWaits());
    }
    SimulationResult result;
    result.seconds = end_;
    for (Task& task : tasks_) {
      task.times.absent += end_;
      result.tasks.push_back(task.times);
    }
    return result;
  }

  std::string WhoWaits() const {
    const auto contains = [](const auto& waiting, int t) {
      return std::find(waiting.begin(), waiting.end(), t) != waiting.end();
    };
    for (int t = 0; t < program_.num_tasks(); ++t) {
      if (tasks_[At(t)].complete) continue;
      const auto sentence = [&](const char* what, std::size_t index) {
        return fmt::format("task {} would wait for {} {} for ever", t + 1, what,
                           index + 1);
      };
      for (std::size_t i = 0; i < barriers_.size(); ++i) {
        if (contains(barriers_[i].waiting, t)) return sentence("barrier", i);
      }
      for (std::size_t i = 0; i < events_.size(); ++i) {
        if (contains(events_[i].waiting, t)) return sentence("event", i);
      }
      for (std::size_t i = 0; i < locks_.size(); ++i) {
        if (contains(locks_[i].waiting, t)) return sentence("lock", i);
      }
      for (std::size_t i = 0; i < tasks_.size(); ++i) {
        if (contains(tasks_[i].joiners, t)) return sentence("task", i);
      }
    }
    return "a task would wait for its start for ever";
  }

  const Program& program_;
  const SimulationOptions& options_;
  std::vector<Task> tasks_;
  std::vector<Processor> processors_;
  std::deque<int> free_queue_;  // of kFree
  std::vector<Barrier> barriers_;
  std::vector<Event> events_;
  std::vector<Lock> locks_;
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
