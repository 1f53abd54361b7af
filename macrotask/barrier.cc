#include "macrotask/barrier.h"

#include <stdexcept>
#include <string>

#include "macrotask/check.h"
#include "macrotask/spin_then_sleep.h"

namespace macrotask {
namespace {

int CheckNumTasks(int num_tasks) {
  if (num_tasks >= 1) return num_tasks;
  throw std::invalid_argument("a barrier needs at least 1 task, not " +
                              std::to_string(num_tasks));
}

}  // namespace

BlockingBarrier::BlockingBarrier(int num_tasks) {
  CheckPthread(pthread_barrier_init(&barrier_, nullptr,
                                    static_cast<unsigned>(num_tasks)),
               "pthread_barrier_init");
}

void BlockingBarrier::Sync() {
  const auto never_seen_complete = [] { return false; };
  SpinThenSleep(WaitPolicy::Block(), never_seen_complete, [&] {
    const int error = pthread_barrier_wait(&barrier_);
    if (error == PTHREAD_BARRIER_SERIAL_THREAD) return;  // the last to arrive
    CheckPthread(error, "pthread_barrier_wait");
  });
}

Barrier::Barrier(int num_tasks, WaitPolicy policy)
    : num_tasks_(CheckNumTasks(num_tasks)) {
  if (policy.kind == WaitKind::kBlock) {
    algorithm_.emplace<BlockingBarrier>(num_tasks);
  } else {
    algorithm_.emplace<CountingBarrier>(num_tasks, policy);
  }
}

void Barrier::Sync() {
  if (auto* counting = std::get_if<CountingBarrier>(&algorithm_)) {
    counting->Sync();
  } else {
    std::get<BlockingBarrier>(algorithm_).Sync();
  }
}

}  // namespace macrotask
