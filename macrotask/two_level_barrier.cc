#include "macrotask/two_level_barrier.h"

#include "macrotask/futex.h"
#include "macrotask/processor_load.h"
#include "macrotask/program_end.h"
#include "macrotask/spin_then_sleep.h"

// With n tasks, phase k (from 0) is complete when (k + 1) n arrivals are
// counted, which is the name of its end below.
//
// The arrival that completes a phase wakes the sleepers of every group but
// those that are watched for this very phase; there the watcher does it when it
// sees the phase complete, or when it gives up watching and then finds it
// complete. All of the steps below are in one order that everybody agrees on
// (sequentially consistent), hence:
//
// Nobody is left to a watcher that is not there. The watcher writes the end of
// its phase before it arrives, and erases it before it asks for the last time
// whether the phase is complete. If the completing arrival finds the end, the
// erasing and that last question come later, and the answer is yes. What it
// finds may have been written by one watcher and erased by another of the same
// phase, or replaced by one that is in the next phase already: then it wakes
// the sleepers itself, once too often at worst.
//
// No sleeper is lost. In one step it counts itself and reads the number of
// wake-ups; then it asks whether its phase is complete, and sleeps if the number
// is still the same. Whoever wakes has seen the phase complete, and then in one
// step changes the number and sets the count to nobody. Either the sleeper's
// question comes after the completing arrival: then it does not sleep. Or it
// comes before: then it was counted before the other one looks, and the number
// changes after it has read it. One that is woken too early has been taken from
// the count, as the number tells, and counts itself again.

namespace macrotask {
namespace {

constexpr std::uint64_t kOneAsleep = std::uint64_t{1} << 32;

int NumAsleep(std::uint64_t sleepers) {
  return static_cast<int>(sleepers >> 32);
}

std::uint32_t WakeUps(std::uint64_t sleepers) {
  return static_cast<std::uint32_t>(sleepers);
}

}  // namespace

TwoLevelBarrier::TwoLevelBarrier(int num_tasks, const WaitPolicy& policy,
                                 std::uint32_t number)
    : num_tasks_(static_cast<std::uint64_t>(num_tasks)),
      policy_(policy),
      waited_{ObjectKind::kBarrier, number},
      num_groups_(NumProcessorLoads() + 1),
      groups_(new Group[static_cast<std::size_t>(num_groups_)]) {}

TwoLevelBarrier::~TwoLevelBarrier() {
  // Tasks may still look at them.
  if (caller_stops_program) (void)groups_.release();
}

bool TwoLevelBarrier::IsComplete(std::uint64_t end_of_phase) const {
  return arrivals_.load(std::memory_order_seq_cst) >= end_of_phase;
}

void TwoLevelBarrier::Sync() {
  if (num_tasks_ == 1) return;
  ProcessorLoad* const shared = load_of_own_processor;
  Group& group = groups_[shared != nullptr ? shared->index : num_groups_ - 1];
  // Relaxed: this task has seen the end of the phase before, and its own cannot
  // end without it.
  const std::uint64_t end_of_phase =
      (arrivals_.load(std::memory_order_relaxed) / num_tasks_ + 1) * num_tasks_;
  const bool watches = shared != nullptr && shared->IsAlone();
  if (watches) group.watched.store(end_of_phase, std::memory_order_seq_cst);
  const std::uint64_t arrivals =
      arrivals_.fetch_add(1, std::memory_order_seq_cst);
  if (arrivals + 1 == end_of_phase) return Release(group, end_of_phase);

  const auto is_complete = [&] { return IsComplete(end_of_phase); };
  if (!watches) {
    return SpinThenSleep(policy_, waited_, is_complete,
                         [&] { SleepUntil(group, end_of_phase); });
  }
  SpinThenSleep(
      policy_, waited_, is_complete,
      [&] {
        group.watched.store(0, std::memory_order_seq_cst);
        SleepUntil(group, end_of_phase);
      },
      [&] { return !shared->IsAlone(); });
  WakeSleepers(group);
}

void TwoLevelBarrier::Release(const Group& own, std::uint64_t end_of_phase) {
  for (int i = 0; i < num_groups_; ++i) {
    Group& group = groups_[i];
    if (&group == &own) continue;
    if (group.watched.load(std::memory_order_seq_cst) != end_of_phase) {
      WakeSleepers(group);
    }
  }
  // Last, as they want this processor.
  WakeSleepers(groups_[&own - groups_.get()]);
}

void TwoLevelBarrier::WakeSleepers(Group& group) {
  std::uint64_t sleepers = group.sleepers.load(std::memory_order_seq_cst);
  do {
    if (NumAsleep(sleepers) == 0) return;
  } while (!group.sleepers.compare_exchange_weak(
      sleepers, WakeUps(sleepers) + 1, std::memory_order_seq_cst));
  // Before they run: the next to arrive shall know that it is not alone.
  const auto index = static_cast<int>(&group - groups_.get());
  if (index < num_groups_ - 1) LoadOfProcessor(index).Add(NumAsleep(sleepers));
  FutexWakeAll(group.sleepers);
}

// Whoever wakes the caller has counted it as awake, which SpinThenSleep() is
// about to do, too, and which is too early if it sleeps on.
void TwoLevelBarrier::SleepUntil(Group& group, std::uint64_t end_of_phase) {
  ProcessorLoad* const shared = load_of_own_processor;
  for (;;) {
    std::uint64_t sleepers =
        group.sleepers.fetch_add(kOneAsleep, std::memory_order_seq_cst) +
        kOneAsleep;
    const std::uint32_t wake_ups = WakeUps(sleepers);
    while (WakeUps(sleepers) == wake_ups) {
      if (!IsComplete(end_of_phase)) {
        FutexWait(group.sleepers, wake_ups);
        sleepers = group.sleepers.load(std::memory_order_seq_cst);
      } else if (group.sleepers.compare_exchange_weak(
                     sleepers, sleepers - kOneAsleep,
                     std::memory_order_seq_cst)) {
        return;
      }
    }
    if (shared != nullptr) shared->Add(-1);
    if (IsComplete(end_of_phase)) return;
  }
}

int TwoLevelBarrier::num_waiting() const {
  return static_cast<int>(arrivals_.load(std::memory_order_relaxed) %
                          num_tasks_);
}

}  // namespace macrotask
