#include "macrotask/placement.h"

#include <pthread.h>
#include <sched.h>

#include <algorithm>
#include <atomic>
#include <stdexcept>
#include <vector>

#include "macrotask/affinity.h"
#include "macrotask/load.h"

namespace macrotask {
namespace {

// Ascending.
std::vector<int> AskProcessors() {
  std::vector<int> processors;
  // A machine of more than CPU_SETSIZE processors refuses the fixed-size mask:
  // there we know of processor 0 only, and use it.
  cpu_set_t mask;
  CPU_ZERO(&mask);
  if (sched_getaffinity(0, sizeof mask, &mask) != 0) CPU_SET(0, &mask);
  for (int processor = 0; processor < CPU_SETSIZE; ++processor) {
    if (CPU_ISSET(processor, &mask)) processors.push_back(processor);
  }
  return processors;
}

// All that the process may use; never destroyed, because tasks may outlive the
// static objects.
const std::vector<int>& TheProcessors() {
  static const auto* processors = new std::vector<int>(AskProcessors());
  return *processors;
}

std::atomic<int> affinity_version{0};

[[maybe_unused]] const int asked_when_loaded = NumProcessors();

std::string Count(int number, const std::string& noun) {
  return std::to_string(number) + " " + noun + (number == 1 ? "" : "s");
}

}  // namespace

int NumProcessors() {
  int number = load.num_processors.load(std::memory_order_relaxed);
  if (number > 0) return number;
  number = static_cast<int>(TheProcessors().size());
  load.num_processors.store(number, std::memory_order_relaxed);
  return number;
}

void SetMaxProcessors(int num_processors) {
  if (num_processors < 1) {
    throw std::invalid_argument("at most " + std::to_string(num_processors) +
                                " processors: expected 1 or more");
  }
  load.num_processors.store(
      std::min(num_processors, static_cast<int>(TheProcessors().size())),
      std::memory_order_relaxed);
  affinity_version.fetch_add(1, std::memory_order_relaxed);
  MoveCallerTo(kAnyProcessor);
}

bool IsUsable(int processor) {
  const auto& usable = TheProcessors();
  const auto end = usable.begin() + NumProcessors();
  return std::find(usable.begin(), end, processor) != end;
}

Placement::Placement(int num_tasks)
    : num_tasks_(num_tasks), pinned_(num_tasks <= NumProcessors()) {
  if (num_tasks < 1) {
    throw std::invalid_argument("a placement needs at least 1 task, not " +
                                std::to_string(num_tasks));
  }
}

int Placement::processor(int task) const {
  if (!pinned_) return kAnyProcessor;
  return TheProcessors().at(static_cast<std::size_t>(task));
}

std::string Placement::ToString() const {
  if (!pinned_) {
    return Count(num_tasks_, "task") + " on " +
           Count(NumProcessors(), "processor") + ", not pinned";
  }
  std::string text = Count(num_tasks_, "task") + " pinned: ";
  for (int task = 0; task < num_tasks_; ++task) {
    if (task > 0) text += ", ";
    text += "task " + std::to_string(task) + " on processor " +
            std::to_string(processor(task));
  }
  return text;
}

cpu_set_t AffinityFor(int processor) {
  cpu_set_t set;
  CPU_ZERO(&set);
  if (processor != kAnyProcessor) {
    CPU_SET(processor, &set);
    return set;
  }
  for (int i = 0; i < NumProcessors(); ++i) {
    CPU_SET(TheProcessors()[static_cast<std::size_t>(i)], &set);
  }
  return set;
}

int AffinityVersion() {
  return affinity_version.load(std::memory_order_relaxed);
}

bool MoveCallerTo(int processor) {
  const cpu_set_t target = AffinityFor(processor);
  return pthread_setaffinity_np(pthread_self(), sizeof target, &target) == 0;
}

ScopedProcessor::ScopedProcessor(int processor) {
  if (processor == kAnyProcessor) return;
  if (pthread_getaffinity_np(pthread_self(), sizeof before_, &before_) != 0) {
    return;
  }
  moved_ = MoveCallerTo(processor);
}

ScopedProcessor::~ScopedProcessor() {
  if (moved_) pthread_setaffinity_np(pthread_self(), sizeof before_, &before_);
}

}  // namespace macrotask
