#include "macrotask/placement.h"

#include <pthread.h>
#include <sched.h>

#include <stdexcept>
#include <vector>

#include "macrotask/affinity.h"

namespace macrotask {
namespace {

struct Processors {
  cpu_set_t mask;
  std::vector<int> numbers;  // (NumProcessors()) ascending
};

Processors AskProcessors() {
  Processors processors;
  // A machine of more than CPU_SETSIZE processors refuses the fixed-size mask:
  // there we know of processor 0 only, and use it.
  CPU_ZERO(&processors.mask);
  if (sched_getaffinity(0, sizeof processors.mask, &processors.mask) != 0) {
    CPU_SET(0, &processors.mask);
  }
  for (int number = 0; number < CPU_SETSIZE; ++number) {
    if (CPU_ISSET(number, &processors.mask)) {
      processors.numbers.push_back(number);
    }
  }
  return processors;
}

// Never destroyed, because tasks may outlive the static objects.
const Processors& TheProcessors() {
  static const Processors* processors = new Processors(AskProcessors());
  return *processors;
}

std::string Count(int number, const std::string& noun) {
  return std::to_string(number) + " " + noun + (number == 1 ? "" : "s");
}

}  // namespace

int NumProcessors() { return static_cast<int>(TheProcessors().numbers.size()); }

bool IsUsable(int processor) {
  return processor >= 0 && processor < CPU_SETSIZE &&
         CPU_ISSET(processor, &TheProcessors().mask);
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
  return TheProcessors().numbers.at(static_cast<std::size_t>(task));
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
  if (processor == kAnyProcessor) return TheProcessors().mask;
  cpu_set_t only;
  CPU_ZERO(&only);
  CPU_SET(processor, &only);
  return only;
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
