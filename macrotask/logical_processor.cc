#include "macrotask/logical_processor.h"

#include <cxxabi.h>
#include <sched.h>
#include <time.h>

#include <algorithm>
#include <atomic>
#include <bit>
#include <chrono>
#include <utility>

#include "macrotask/deadlock.h"
#include "macrotask/load.h"
#include "macrotask/logical_barrier.h"
#include "macrotask/logical_wait.h"
#include "macrotask/placement.h"
#include "macrotask/spin_then_sleep.h"
#include "macrotask/stack_switch.h"
#include "macrotask/task.h"
#include "macrotask/task_registry.h"
#include "macrotask/trace_point.h"

namespace macrotask {
namespace {

// The pthread's own, which the tasks of a processor never leave.
ExceptionState& ExceptionsOfPthread() {
  return *reinterpret_cast<ExceptionState*>(abi::__cxa_get_globals());
}

// Whether the barrier at which `task` waits is past the end of its phase.
bool BarrierIsPast(const void* task) {
  const auto* const waiter = static_cast<const LogicalTask*>(task);
  return waiter->barrier->IsPast(waiter->end_of_phase);
}

}  // namespace

void LogicalProcessor::Add(LogicalTask* task,
                           const std::function<void(int)>& body, int index) {
  task->processor = this;
  task->body = &body;
  task->index = index;
  task->failure = nullptr;
  task->has_record_of_pthread = tasks_.empty();
  if (tasks_.empty()) {
    task->record = &RecordOfCaller();
    task->number = task->record->number();
    task->next = task->previous = task;
  } else {
    task->record = TaskRegistry::TheOne().Acquire();
    task->number = NextTaskNumber();
    task->record->SetReady(task->number, 0);
    RecordIf(TraceClass::kTasks, TraceAction::kTaskStart,
             TraceData(task->number));
    task->next = tasks_.front();
    task->previous = tasks_.back();
    tasks_.back()->next = tasks_.front()->previous = task;
  }
  tasks_.push_back(task);
  ++num_left_;
}

std::exception_ptr LogicalProcessor::Run() {
  exceptions_ = &ExceptionsOfPthread();
  pthread_.processor = this;
  pthread_.annotations.Adopt();
  pthread_.record = &RecordOfCaller();
  pthread_.number = number_of_caller;
  current_ = &pthread_;
  processor_of_caller = this;
  SwitchTo(tasks_.front());
  processor_of_caller = nullptr;
  RecordWaitForNeighbours();
  std::exception_ptr failure;
  for (LogicalTask* task : tasks_) {
    if (!task->has_record_of_pthread) {
      TaskRegistry::TheOne().Release(task->record);
    }
    if (!failure) failure = task->failure;
  }
  return failure;
}

// By the stack that was switched to: the one that it came from can be resumed
// from now on.
inline void LogicalProcessor::Arrive(Stack from) {
  previous_->context = from;
  current_->annotations.Enter(&previous_->annotations);
  *exceptions_ = current_->exceptions;
}

inline void LogicalProcessor::SwitchTo(LogicalTask* task) {
  LogicalTask* const self = current_;
  previous_ = self;
  current_ = task;
  record_of_caller = task->record;
  number_of_caller = task->number;
  self->exceptions = *exceptions_;
  self->annotations.Leave(task->annotations);
  const Stack from = SwitchStack(task->context, task).fctx;
  // Not `this`: one whose body had ended may be of another processor by now.
  self->processor->Arrive(from);
}

void LogicalProcessor::RunBodies(boost::context::detail::transfer_t from) {
  auto* const task = static_cast<LogicalTask*>(from.data);
  task->processor->Arrive(from.fctx);
  for (;;) {
    task->RunBody();
    task->processor->Finish();
  }
}

// By a task whose body has ended. Returns when it is given another one.
void LogicalProcessor::Finish() {
  LogicalTask* const task = current_;
  task->next->previous = task->previous;
  task->previous->next = task->next;
  --num_left_;
  // The pthread must be seen to run before its last task is seen to have ended,
  // and not while it only waits for the others.
  if (num_left_ == 0) pthread_.record->SetRunning(pthread_.number);
  if (num_left_ > 0 || !task->has_record_of_pthread) {
    task->record->SetComplete();
  }
  if (num_left_ > 0 && task->has_record_of_pthread) {
    waits_for_neighbours_ = true;
    RecordIf(TraceClass::kTasks, TraceAction::kTaskWait,
             TraceData(tasks_[1]->number));
  }
  SwitchTo(num_left_ == 0 ? &pthread_ : NextTurn(task->next));
}

// By the pthread, when all bodies have ended. In the history trace its first
// task, which bears its number, waits for the others.
void LogicalProcessor::RecordWaitForNeighbours() {
  for (std::size_t i = 1; i < tasks_.size(); ++i) {
    const std::uint64_t data = TraceData(tasks_[i]->number);
    if (i > 1 || !waits_for_neighbours_) {
      RecordIf(TraceClass::kTasks, TraceAction::kTaskWait, data);
    }
    RecordIf(TraceClass::kTasks, TraceAction::kTaskWaitEnd, data);
  }
  waits_for_neighbours_ = false;
}

void LogicalProcessor::Wait(const WaitedObject& what,
                            TaskRecord::IsOver is_over, const void* wait) {
  LogicalTask* const task = current_;
  task->what = &what;
  task->is_over = is_over;
  task->wait = wait;
  LogicalTask* const next = NextTurn(task->next);
  if (next != task) SwitchTo(next);
  task->is_over = nullptr;
}

void LogicalProcessor::WaitAt(LogicalBarrier& barrier,
                              std::uint64_t end_of_phase,
                              const WaitedObject& what) {
  LogicalTask* const task = current_;
  task->barrier = &barrier;
  task->end_of_phase = end_of_phase;
  Wait(what, &BarrierIsPast, task);
  task->barrier = nullptr;
}

void LogicalProcessor::Yield() {
  Flush();
  LogicalTask* const task = current_;
  LogicalTask* const next = NextTurn(task->next);
  if (next == task) {
    if (MoreTasksThanProcessors()) sched_yield();
    return;
  }
  SwitchTo(next);
}

// The first in the ring, from `first` on, that can go on; null if none can.
// Neighbours often wait for the same phase: one of them asks, and if that is
// all of them, `one_for_all` is it.
inline LogicalTask* LogicalProcessor::FindRunnable(
    LogicalTask* first, LogicalTask** one_for_all) const {
  LogicalTask* asked = nullptr;
  int num_asked = 0;
  LogicalTask* task = first;
  do {
    if (task->is_over == nullptr) return task;
    if (asked == nullptr || !task->WaitsLike(*asked)) {
      if (IsOver(*task)) return task;
      asked = task;
      ++num_asked;
    }
    task = task->next;
  } while (task != first);
  *one_for_all = num_asked == 1 ? first : nullptr;
  return nullptr;
}

inline bool LogicalProcessor::IsOver(const LogicalTask& task) const {
  return task.barrier != nullptr
             ? task.barrier->IsPast(task.end_of_phase, slot())
             : task.is_over(task.wait);
}

LogicalTask* LogicalProcessor::NextTurn(LogicalTask* first) {
  // As long as there is always another task that can go on, others would wait
  // for ever for what is not flushed.
  if (!unflushed_.empty() && ++num_turns_ > num_left_) Flush();
  LogicalTask* one_for_all = nullptr;
  LogicalTask* const task = FindRunnable(first, &one_for_all);
  return task != nullptr ? task : AwaitRunnable(first, one_for_all);
}

// All tasks of this processor wait for those of others.
LogicalTask* LogicalProcessor::AwaitRunnable(LogicalTask* first,
                                             LogicalTask* one_for_all) {
  using Clock = std::chrono::steady_clock;
  Flush();
  Clock::time_point start;
  for (int looks = 0;; ++looks) {
    for (int i = 0; i < kPausesPerLook; ++i) {
      LogicalTask* task = nullptr;
      if (one_for_all == nullptr) {
        task = FindRunnable(first, &one_for_all);
      } else if (IsOver(*one_for_all)) {
        task = one_for_all;
      }
      if (task != nullptr) {
        if (waits_are_published_) EndWaits();
        return task;
      }
      Pause();
    }
    // The first look only starts the clock: short waits never read it.
    if (looks == 0) start = Clock::now();
    const auto waited = Clock::now() - start;
    if (waited < kDefaultHoldTime) continue;
    if (!waits_are_published_) PublishWaits();
    // The processor may be wanted by others; then it is asked for seldom.
    constexpr auto kPatience = std::chrono::milliseconds(1);
    constexpr timespec kNap = {.tv_sec = 0, .tv_nsec = 50'000};
    if (waited < kPatience) {
      sched_yield();
    } else {
      nanosleep(&kNap, nullptr);
    }
  }
}

void LogicalProcessor::PublishWaits() {
  LogicalTask* const first = current_->next;
  LogicalTask* task = first;
  do {
    if (task->what->kind != ObjectKind::kNone) {
      task->record->BeginWait(*task->what, task->is_over, task->wait);
    }
    task = task->next;
  } while (task != first);
  waits_are_published_ = true;
  DetectDeadlock();
}

void LogicalProcessor::EndWaits() {
  LogicalTask* const first = current_->next;
  LogicalTask* task = first;
  do {
    if (task->what->kind != ObjectKind::kNone) task->record->EndWait();
    task = task->next;
  } while (task != first);
  waits_are_published_ = false;
}

void LogicalProcessor::Flush() {
  num_turns_ = 0;
  while (!unflushed_.empty()) unflushed_.back()->Publish(this);
}

void WaitLogically(const WaitedObject& what, TaskRecord::IsOver is_over,
                   const void* wait) {
  processor_of_caller->Wait(what, is_over, wait);
}

void GiveWay() {
  if (processor_of_caller != nullptr) {
    processor_of_caller->Yield();
  } else if (MoreTasksThanProcessors()) {
    sched_yield();
  }
}

void RunLogicalTasks(int num_tasks, const std::function<void(int)>& body) {
  // Everything that can fail comes before the first start.
  const LogicalTasks tasks(num_tasks);
  const Placement placement(num_tasks);
  RunTasks(
      std::min(NumProcessors(), num_tasks),
      [&](int p) {
        LogicalProcessor processor;
        for (int task = 0; task < num_tasks; ++task) {
          if (placement.index(task) != p) continue;
          processor.Add(tasks[task], body, task);
        }
        if (const std::exception_ptr failure = processor.Run()) {
          std::rethrow_exception(failure);
        }
      },
      WaitPolicy::Hold());
}

}  // namespace macrotask
