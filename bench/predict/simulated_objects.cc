#include "bench/predict/simulated_objects.h"

#include <fmt/format.h>

#include <algorithm>

namespace bench::predict {
namespace {

// Index of the first of `objects` where `task` is among those that wait, or
// their number.
template <typename Object, typename Waiting>
std::size_t Find(const std::vector<Object>& objects, Waiting Object::*waiting,
                 int task) {
  const auto waits_here = [&](const Object& object) {
    const Waiting& tasks = object.*waiting;
    return std::find(tasks.begin(), tasks.end(), task) != tasks.end();
  };
  const auto found = std::find_if(objects.begin(), objects.end(), waits_here);
  return static_cast<std::size_t>(found - objects.begin());
}

// The name of what `task` waits for; "" if it does not wait.
std::string WhatFor(int task, const std::vector<SimulatedTask>& tasks,
                    const SimulatedObjects& objects) {
  const auto& [barriers, events, locks] = objects;
  const std::size_t barrier = Find(barriers, &SimulatedBarrier::waiting, task);
  if (barrier < barriers.size()) return fmt::format("barrier {}", barrier + 1);
  const std::size_t event = Find(events, &SimulatedEvent::waiting, task);
  if (event < events.size()) return fmt::format("event {}", event + 1);
  const std::size_t lock = Find(locks, &SimulatedLock::waiting, task);
  if (lock < locks.size()) return fmt::format("lock {}", lock + 1);
  const std::size_t other = Find(tasks, &SimulatedTask::joiners, task);
  if (other < tasks.size()) return fmt::format("task {}", other + 1);
  return "";
}

}  // namespace

SimulatedObjects::SimulatedObjects(const Program& program)
    : events(static_cast<std::size_t>(program.num_events)),
      locks(static_cast<std::size_t>(program.num_locks)) {
  for (const int num_tasks : program.barriers) barriers.push_back({num_tasks});
}

std::string WhoWaits(const std::vector<SimulatedTask>& tasks,
                     const SimulatedObjects& objects) {
  for (std::size_t t = 0; t < tasks.size(); ++t) {
    if (tasks[t].complete) continue;
    const std::string what = WhatFor(static_cast<int>(t), tasks, objects);
    if (what.empty()) continue;
    return fmt::format("task {} would wait for {} for ever", t + 1, what);
  }
  return "a task would wait for its start for ever";
}

}  // namespace bench::predict
