#include "bench/predict/simulated_processors.h"

#include <algorithm>
#include <cstddef>

namespace bench::predict {

SimulatedProcessors::SimulatedProcessors(int number, TaskPlacement placement,
                                         int num_tasks)
    : placement_(placement), processors_(static_cast<std::size_t>(number)) {
  const long used = std::min(num_tasks, number);
  for (int task = 0; task < num_tasks; ++task) {
    places_.push_back(static_cast<int>(task * used / num_tasks));
  }
}

std::optional<SimulatedProcessors::Turn> SimulatedProcessors::Take(int task) {
  if (placement_ == TaskPlacement::kFree && ProcessorOf(task).task) {
    const auto idle =
        std::find_if(processors_.begin(), processors_.end(),
                     [](const Processor& other) { return !other.task; });
    if (idle == processors_.end()) {
      free_queue_.push_back(task);
      return {};
    }
    places_[static_cast<std::size_t>(task)] =
        static_cast<int>(idle - processors_.begin());
  }
  Processor& processor = ProcessorOf(task);
  if (!processor.task) return Give(&processor, task);
  processor.queue.push_back(task);
  return {};
}

std::optional<SimulatedProcessors::Turn> SimulatedProcessors::Leave(int task) {
  Processor& processor = ProcessorOf(task);
  processor.task.reset();
  std::deque<int>& queue =
      placement_ == TaskPlacement::kFree ? free_queue_ : processor.queue;
  if (queue.empty()) return {};
  const int next = queue.front();
  queue.pop_front();
  places_[static_cast<std::size_t>(next)] =
      places_[static_cast<std::size_t>(task)];
  return Give(&processor, next);
}

bool SimulatedProcessors::AreNeighbours(int task, int other) const {
  return placement_ == TaskPlacement::kPinned &&
         places_[static_cast<std::size_t>(task)] ==
             places_[static_cast<std::size_t>(other)];
}

SimulatedProcessors::Processor& SimulatedProcessors::ProcessorOf(int task) {
  const int place = places_[static_cast<std::size_t>(task)];
  return processors_[static_cast<std::size_t>(place)];
}

SimulatedProcessors::Turn SimulatedProcessors::Give(Processor* processor,
                                                    int task) {
  const bool follows = processor->last && processor->last != task;
  processor->task = processor->last = task;
  return {task, follows};
}

}  // namespace bench::predict
