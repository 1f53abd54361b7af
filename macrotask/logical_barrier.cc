#include "macrotask/logical_barrier.h"

#include "macrotask/logical_wait.h"
#include "macrotask/spin_then_sleep.h"

// With n tasks, phase k (from 0) is complete when (k + 1) n arrivals are
// published.
//
// The phase of an arrival is the number of complete phases: all phases before
// are complete, as this task has left them, and its own is not, as this arrival
// is missing. While a processor has arrivals that are not published their phase
// cannot be complete, and others of the processor's tasks that arrive belong to
// it. Otherwise the sum is read: it lies in [k n, (k + 1) n), however the lines
// are read one after the other, as every line only grows.
//
// Published is late, so that a line changes hands once a phase: when as many of
// the processor's tasks have arrived as in the phase before, or before the
// processor has nothing to do, or after every task had a turn. Which of these
// is a question of speed only.

namespace macrotask {

std::uint64_t LogicalBarrier::EndOfPhase() const {
  return (NumArrivals() / num_tasks_ + 1) * num_tasks_;
}

// Each of the functions ends in the call of the next one, which is a jump:
// nothing is left on the stack of a task that waits but the wait.
void LogicalBarrier::Sync() {
  if (num_tasks_ == 1) return;
  LogicalProcessor* const processor = processor_of_caller;
  if (processor == nullptr || processor->slot() == LogicalSlot::kNone) {
    return SyncOfPthread();
  }
  Count& count = counts_[processor->slot()];
  if (count.pending == 0) return SyncFirst(processor, count);
  SyncNext(processor, count);
}

void LogicalBarrier::SyncFirst(LogicalProcessor* processor, Count& count) {
  const std::uint64_t end = EndOfPhase();
  if (end != count.end_of_phase) {
    count.expected = count.arrived;
    count.arrived = 0;
    count.end_of_phase = end;
  }
  processor->FlushLater(this);
  SyncNext(processor, count);
}

inline void LogicalBarrier::SyncNext(LogicalProcessor* processor,
                                     Count& count) {
  ++count.pending;
  if (++count.arrived == count.expected) return SyncLast(processor, count);
  processor->WaitAt(*this, count.end_of_phase, waited_);
}

void LogicalBarrier::SyncLast(LogicalProcessor* processor, Count& count) {
  Publish(processor);
  if (IsPast(count.end_of_phase, processor->slot())) return;
  processor->WaitAt(*this, count.end_of_phase, waited_);
}

void LogicalBarrier::SyncOfPthread() {
  const std::uint64_t end_of_phase = EndOfPhase();
  TakePart(kSlotOfPthreads);
  // Release: partner of the acquire in NumArrivals().
  lines_[kSlotOfPthreads].arrivals.fetch_add(1, std::memory_order_release);
  SpinThenSleep(
      WaitPolicy::Spin(), waited_, [&] { return IsPast(end_of_phase); }, [] {});
}

void LogicalBarrier::TakePart(int slot) {
  const std::uint64_t bit = std::uint64_t{1} << slot;
  if (slots_.load(std::memory_order_relaxed) & bit) return;
  // Release: whoever then adds up the lines sees this one's slot.
  slots_.fetch_or(bit, std::memory_order_release);
}

void LogicalBarrier::Publish(LogicalProcessor* processor) {
  const int slot = processor->slot();
  Count& count = counts_[slot];
  std::atomic<std::uint64_t>& arrivals = lines_[slot].arrivals;
  TakePart(slot);
  // Release: partner of the acquire in NumArrivals().
  arrivals.store(arrivals.load(std::memory_order_relaxed) + count.pending,
                 std::memory_order_release);
  count.pending = 0;
  processor->IsFlushed(this);
}

int LogicalBarrier::num_waiting() const {
  return static_cast<int>(NumArrivals() % num_tasks_);
}

}  // namespace macrotask
