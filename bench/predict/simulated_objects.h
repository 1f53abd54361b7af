#pragma once

#include <cstddef>
#include <deque>
#include <string>
#include <vector>

#include "bench/predict/program.h"
#include "bench/predict/simulated_task.h"

// Internal: the objects of a simulation at which its tasks meet.

namespace bench::predict {

struct SimulatedBarrier {
  int num_tasks = 0;
  std::vector<int> waiting = {};
};

struct SimulatedEvent {
  bool posted = false;
  double posted_at = 0;
  std::vector<int> waiting = {};
};

struct SimulatedLock {
  bool taken = false;
  std::deque<int> waiting = {};
};

struct SimulatedObjects {
  explicit SimulatedObjects(const Program& program);

  std::vector<SimulatedBarrier> barriers;
  std::vector<SimulatedEvent> events;
  std::vector<SimulatedLock> locks;
};

// One sentence: the first of the tasks that are not complete, and what it would
// wait for for ever.
std::string WhoWaits(const std::vector<SimulatedTask>& tasks,
                     const SimulatedObjects& objects);

}  // namespace bench::predict
