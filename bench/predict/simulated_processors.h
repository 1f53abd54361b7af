#pragma once

#include <deque>
#include <optional>
#include <vector>

#include "bench/predict/simulation.h"

namespace bench::predict {

// Internal: who has which processor of a simulation, and who queues for one.
class SimulatedProcessors {
 public:
  // A task that is given a processor.
  struct Turn {
    int task;
    bool follows;  // another one, which had the processor last
  };

  // Each task is at home on one of `number` processors: neighbours together, as
  // many or one more on each.
  SimulatedProcessors(int number, TaskPlacement placement, int num_tasks);

  int number() const { return static_cast<int>(processors_.size()); }

  // `task` is ready: has its turn, or queues.
  std::optional<Turn> Take(int task);

  // `task` waits or has ended: the next one has its processor.
  std::optional<Turn> Leave(int task);

  // Whether a task that another one lets go finds it on its own processor.
  bool AreNeighbours(int task, int other) const;

 private:
  struct Processor {
    std::optional<int> task;  // that has it
    std::optional<int> last;  // that had it last
    std::deque<int> queue;    // of kPinned
  };

  Processor& ProcessorOf(int task);
  Turn Give(Processor* processor, int task);

  const TaskPlacement placement_;
  std::vector<Processor> processors_;
  // By task: the processor that it has, had last, or is at home on.
  std::vector<int> places_;
  std::deque<int> free_queue_;  // of kFree
};

}  // namespace bench::predict
