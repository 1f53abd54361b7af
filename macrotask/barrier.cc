#include "macrotask/barrier.h"

#include <stdexcept>
#include <string>

#include "macrotask/check.h"
#include "macrotask/logical_barrier.h"
#include "macrotask/logical_wait.h"
#include "macrotask/placement.h"
#include "macrotask/program_end.h"
#include "macrotask/published_wait.h"
#include "macrotask/spin_then_sleep.h"
#include "macrotask/trace_point.h"
#include "macrotask/undecided_barrier.h"

namespace macrotask {
namespace {

int CheckNumTasks(int num_tasks) {
  if (num_tasks >= 1) return num_tasks;
  throw std::invalid_argument("a barrier needs at least 1 task, not " +
                              std::to_string(num_tasks));
}

}  // namespace

BlockingBarrier::BlockingBarrier(int num_tasks, std::uint32_t number)
    : num_tasks_(static_cast<std::uint64_t>(num_tasks)),
      waited_{ObjectKind::kBarrier, number} {
  CheckPthread(pthread_barrier_init(&barrier_, nullptr,
                                    static_cast<unsigned>(num_tasks)),
               "pthread_barrier_init");
}

BlockingBarrier::~BlockingBarrier() {
  // It would wait for those who sleep.
  if (!caller_stops_program) pthread_barrier_destroy(&barrier_);
}

void BlockingBarrier::Sync() {
  // Acquire and release: logical tasks are ordered by nothing else.
  const std::uint64_t arrivals =
      arrivals_.fetch_add(1, std::memory_order_acq_rel);
  const std::uint64_t end_of_phase = (arrivals / num_tasks_ + 1) * num_tasks_;
  const auto is_over = [&] {
    return arrivals_.load(std::memory_order_acquire) >= end_of_phase;
  };
  if (processor_of_caller != nullptr) {
    // All tasks of the processor would sleep with the caller.
    return SpinThenSleep(WaitPolicy::Block(), waited_, is_over, [] {});
  }
  const auto wait = [&] {
    const int error = pthread_barrier_wait(&barrier_);
    if (error == PTHREAD_BARRIER_SERIAL_THREAD) return;  // one of them
    CheckPthread(error, "pthread_barrier_wait");
  };
  // The last to arrive sleeps no more than the others by now.
  if (arrivals + 1 == end_of_phase) return wait();
  const PublishedWait published(waited_, is_over);
  published.BeginSleep();
  wait();
  published.EndSleep();
}

int BlockingBarrier::num_waiting() const {
  return static_cast<int>(arrivals_.load(std::memory_order_relaxed) %
                          num_tasks_);
}

// Sync() and Sync(member) live side by side, each with a state that the other
// one does not touch: its own phases, one after the other. That is enough. The
// proofs of each algorithm ask that a task comes to its next phase only after
// the one before is complete, and that those of one phase are all tasks, once
// each. A phase of the other kind in between only makes a task come later, and
// as all of them come through it, what they know of each other's writes is no
// less.
Barrier::Barrier(int num_tasks, WaitPolicy policy, BarrierAlgorithm algorithm)
    : num_tasks_(CheckNumTasks(num_tasks)),
      policy_(policy),
      number_(NextNumber(ObjectKind::kBarrier)) {
  ChooseAlgorithm(algorithm);
  ChooseMemberAlgorithm(algorithm);
}

void Barrier::ChooseAlgorithm(BarrierAlgorithm algorithm) {
  if (algorithm == BarrierAlgorithm::kCounter) {
    algorithm_.emplace<CountingBarrier>(num_tasks_, policy_, number_);
  } else if (policy_.kind == WaitKind::kBlock) {
    algorithm_.emplace<BlockingBarrier>(num_tasks_, number_);
  } else if (policy_.kind == WaitKind::kLogical) {
    algorithm_ = std::make_unique<LogicalBarrier>(num_tasks_, number_);
  } else if (policy_.kind == WaitKind::kAuto && num_tasks_ > NumProcessors()) {
    algorithm_ =
        std::make_unique<UndecidedBarrier>(num_tasks_, policy_, number_);
  } else if (policy_.kind == WaitKind::kHold && num_tasks_ > NumProcessors()) {
    algorithm_.emplace<TwoLevelBarrier>(num_tasks_, policy_, number_);
  } else {
    algorithm_.emplace<CountingBarrier>(num_tasks_, policy_, number_);
  }
}

void Barrier::ChooseMemberAlgorithm(BarrierAlgorithm algorithm) {
  if (algorithm == BarrierAlgorithm::kAuto) {
    // Where Sync() does something for tasks that share processors, or is what
    // the policy promises, it is as good for members.
    if (num_tasks_ > NumProcessors() ||
        !std::holds_alternative<CountingBarrier>(algorithm_)) {
      return;
    }
    algorithm = ChooseBarrierAlgorithm(num_tasks_);
  }
  if (algorithm == BarrierAlgorithm::kDissemination) {
    member_algorithm_.emplace<DisseminationBarrier>(num_tasks_, policy_,
                                                    number_);
  } else if (algorithm == BarrierAlgorithm::kTree) {
    member_algorithm_.emplace<TreeBarrier>(num_tasks_, policy_, number_);
  }
}

inline void Barrier::SyncUntraced() {
  if (auto* counting = std::get_if<CountingBarrier>(&algorithm_)) {
    counting->Sync();
  } else if (auto* logical =
                 std::get_if<std::unique_ptr<LogicalBarrier>>(&algorithm_)) {
    (*logical)->Sync();
  } else if (auto* undecided =
                 std::get_if<std::unique_ptr<UndecidedBarrier>>(&algorithm_)) {
    (*undecided)->Sync();
  } else if (auto* two_level = std::get_if<TwoLevelBarrier>(&algorithm_)) {
    two_level->Sync();
  } else {
    std::get<BlockingBarrier>(algorithm_).Sync();
  }
}

inline void Barrier::SyncUntraced(int member) {
  if (auto* rounds = std::get_if<DisseminationBarrier>(&member_algorithm_)) {
    rounds->Sync(member);
  } else if (auto* tree = std::get_if<TreeBarrier>(&member_algorithm_)) {
    tree->Sync(member);
  } else {
    SyncUntraced();
  }
}

Barrier::~Barrier() {
  if (!caller_stops_program) return;
  // Tasks may still look at it.
  if (auto* logical =
          std::get_if<std::unique_ptr<LogicalBarrier>>(&algorithm_)) {
    (void)logical->release();
  } else if (auto* undecided =
                 std::get_if<std::unique_ptr<UndecidedBarrier>>(&algorithm_)) {
    (void)undecided->release();
  }
}

void Barrier::Sync() {
  RecordAround(TraceClass::kEvents, TraceAction::kBarrierSync,
               TraceAction::kBarrierSyncEnd,
               TraceData(number_, static_cast<std::uint64_t>(num_tasks_)),
               [this] { SyncUntraced(); });
}

inline void Barrier::CheckMember(int member) const {
  if (member >= 0 && member < num_tasks_) [[likely]]
    return;
  throw std::out_of_range(
      "barrier " + std::to_string(number_) + " has members 0 to " +
      std::to_string(num_tasks_ - 1) + ", not " + std::to_string(member));
}

void Barrier::Sync(int member) {
  CheckMember(member);
  RecordAround(TraceClass::kEvents, TraceAction::kBarrierSync,
               TraceAction::kBarrierSyncEnd,
               TraceData(number_, static_cast<std::uint64_t>(num_tasks_)),
               [this, member] { SyncUntraced(member); });
}

int Barrier::num_waiting() const {
  // In a phase of the other kind nobody waits among members.
  int num_members = 0;
  if (auto* rounds = std::get_if<DisseminationBarrier>(&member_algorithm_)) {
    num_members = rounds->num_waiting();
  } else if (auto* tree = std::get_if<TreeBarrier>(&member_algorithm_)) {
    num_members = tree->num_waiting();
  }
  if (num_members > 0) return num_members;
  if (auto* counting = std::get_if<CountingBarrier>(&algorithm_)) {
    return counting->num_waiting();
  }
  if (auto* logical =
          std::get_if<std::unique_ptr<LogicalBarrier>>(&algorithm_)) {
    return (*logical)->num_waiting();
  }
  if (auto* undecided =
          std::get_if<std::unique_ptr<UndecidedBarrier>>(&algorithm_)) {
    return (*undecided)->num_waiting();
  }
  if (auto* two_level = std::get_if<TwoLevelBarrier>(&algorithm_)) {
    return two_level->num_waiting();
  }
  return std::get<BlockingBarrier>(algorithm_).num_waiting();
}

}  // namespace macrotask
