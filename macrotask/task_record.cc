#include "macrotask/task_record.h"

#include <sched.h>

#include "macrotask/task_registry.h"

namespace macrotask {
namespace {

// Of a task that has not begun to wait.
std::uint64_t EpochOf(std::uint32_t number) {
  return std::uint64_t{number} << 29;
}

}  // namespace

void TaskRecord::SetReady(std::uint32_t number, std::uint64_t value) {
  number_.store(number, std::memory_order_relaxed);
  value_.store(value, std::memory_order_relaxed);
  // Release: partner of the load in Read(). Whoever sees the starter in a later
  // wait of its own sees this as well.
  word_.store(Pack({EpochOf(number), TaskState::kReady}),
              std::memory_order_release);
}

void TaskRecord::SetRunning(std::uint32_t number) {
  // Release: as above; it does no harm if others see it late.
  word_.store(Pack({EpochOf(number), TaskState::kRunning}),
              std::memory_order_release);
  number_of_caller = number;
}

void TaskRecord::SetComplete() {
  Word now = Read();
  if (now.state != TaskState::kRunning) return;
  // May fail only because a starter has set the next task ready.
  Exchange(now, {now.epoch, TaskState::kComplete});
}

void TaskRecord::BeginWait(const WaitedObject& what, IsOver is_over,
                           const void* wait) {
  what_ = &what;
  is_over_ = is_over;
  wait_ = wait;
  // Sequentially consistent here, in SetComplete() and in Read(): of two tasks
  // that come to their end or to a wait at the same time, at least one must see
  // the other when it then looks for a deadlock.
  word_.store(Pack({Read().epoch + 1, TaskState::kWaiting}));
}

void TaskRecord::EndWait() {
  const std::uint64_t epoch = Read().epoch;
  while (
      !Exchange({epoch, TaskState::kWaiting}, {epoch, TaskState::kRunning})) {
    sched_yield();  // Somebody examines the wait: a rare and short thing.
  }
}

TaskRecord::Word TaskRecord::Read() const {
  const std::uint64_t word = word_.load();
  return {word >> 3, static_cast<TaskState>(word & 7)};
}

bool TaskRecord::Exchange(const Word& from, const Word& to) {
  std::uint64_t expected = Pack(from);
  return word_.compare_exchange_strong(expected, Pack(to));
}

}  // namespace macrotask
