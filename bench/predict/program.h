#pragma once

#include <array>
#include <string_view>
#include <vector>

namespace bench::predict {

// What a piece of computing is: the blocks of Figure 1, what the integrator
// adds, and what nobody has named, as in a program of the user's.
enum class Block { kStart, kCs, kOcd, kRma, kCcd, kShift, kOther };
inline constexpr int kNumBlocks = 7;

std::string_view Name(Block block);  // "start", "CS", "OCD", ..., "other"

// What a task does next.
enum class StepKind {
  kCompute,  // for `seconds`
  kBarrier,  // BARSYNC
  kPost,     // EVPOST
  kWait,     // EVWAIT
  kClear,    // EVCLEAR
  kLock,     // LOCKON, or LOCKTEST until it succeeds
  kUnlock,   // LOCKOFF
  kStart,    // TSKSTART
  kJoin,     // TSKWAIT
};

struct Step {
  StepKind kind = StepKind::kCompute;
  Block block = Block::kOther;  // of kCompute
  int object = 0;               // index of the barrier, event, lock, or task
  double seconds = 0;           // of kCompute, median
  double busy = 0;              // of kCompute, too: busy work, varies as kOther

  friend bool operator==(const Step&, const Step&) = default;
};

inline Step Compute(Block block, double seconds = 0) {
  return {StepKind::kCompute, block, 0, seconds, 0};
}
inline Step Sync(StepKind kind, int object) {
  return {kind, Block::kOther, object, 0, 0};
}

// `head`, then `body` so many times, then `tail`.
struct TaskProgram {
  std::vector<Step> head, body, tail;
  long num_bodies = 0;
  bool started = false;  // by a kStart of another task, and not at time 0

  // Calls f(step) for all steps in order.
  template <typename Function>
  void ForEach(const Function& f) const {
    for (const Step& step : head) f(step);
    for (long turn = 0; turn < num_bodies; ++turn) {
      for (const Step& step : body) f(step);
    }
    for (const Step& step : tail) f(step);
  }
};

// What the tasks of a program do, and the objects at which they meet, counted
// from 0. Events are cleared and locks free at the beginning.
struct Program {
  std::vector<TaskProgram> tasks;
  std::vector<int> barriers;  // number of tasks of each
  int num_events = 0;
  int num_locks = 0;

  int num_tasks() const { return static_cast<int>(tasks.size()); }
};

// Computing time of all tasks (s).
double Work(const Program& program);

// Computing time by block, of all tasks (s).
std::array<double, kNumBlocks> WorkByBlock(const Program& program);

}  // namespace bench::predict
