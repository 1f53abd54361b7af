#include "macrotask/placement.h"

#include <pthread.h>
#include <sched.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <stdexcept>
#include <vector>

#include "macrotask/affinity.h"
#include "macrotask/load.h"
#include "macrotask/processor_load.h"

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
    : num_tasks_(num_tasks), num_processors_(NumProcessors()) {
  if (num_tasks < 1) {
    throw std::invalid_argument("a placement needs at least 1 task, not " +
                                std::to_string(num_tasks));
  }
}

int Placement::index(int task) const {
  if (!is_crowded()) return task;
  return static_cast<int>(std::int64_t{task} * num_processors_ / num_tasks_);
}

int Placement::processor(int task) const {
  return TheProcessors().at(static_cast<std::size_t>(index(task)));
}

std::string Placement::ToString() const {
  std::string text = std::to_string(num_tasks_) +
                     (num_tasks_ == 1 ? " task pinned: " : " tasks pinned: ");
  for (int first = 0, last = 0; first < num_tasks_; first = last + 1) {
    for (last = first; last + 1 < num_tasks_ && index(last + 1) == index(first);
         ++last) {
    }
    if (first > 0) text += ", ";
    text += first == last ? "task " + std::to_string(first)
                          : "tasks " + std::to_string(first) + " to " +
                                std::to_string(last);
    text += " on processor " + std::to_string(processor(first));
  }
  return text;
}

int NumProcessorLoads() { return static_cast<int>(TheProcessors().size()); }

ProcessorLoad& LoadOfProcessor(int index) {
  // Never destroyed, as TheProcessors().
  static auto* const loads = [] {
    const int num_loads = NumProcessorLoads();
    auto* const made = new ProcessorLoad[static_cast<std::size_t>(num_loads)];
    for (int i = 0; i < num_loads; ++i) made[i].index = i;
    return made;
  }();
  return loads[index];
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
