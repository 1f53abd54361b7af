#include "macrotask/logical_task.h"

#include <atomic>
#include <boost/context/protected_fixedsize_stack.hpp>
#include <new>
#include <string>
#include <system_error>
#include <utility>

#include "macrotask/cache_line.h"
#include "macrotask/logical_processor.h"
#include "macrotask/mutex.h"
#include "macrotask/task_registry.h"
#include "macrotask/trace_point.h"
#include "macrotask/worker_pool.h"

namespace macrotask {
namespace {

constexpr std::size_t kDefaultStackSize = std::size_t{1} << 20;

// Stacks begin at pages, so that what tasks have on top of them would all fall
// into the same few sets of the first cache, which has room for 8 of them: they
// begin at different lines of the page instead.
constexpr std::size_t kMostColors = 64;

std::size_t NextColor() {
  static std::atomic<std::size_t> num_stacks{0};
  // An odd step goes through all colours, and keeps neighbours apart by more
  // than a frame.
  constexpr std::size_t kStep = 11;
  return num_stacks.fetch_add(1, std::memory_order_relaxed) * kStep %
         kMostColors;
}

// Never destroyed, as a task may outlive the static objects.
struct Parked {
  Mutex mutex;  // guards all below
  LogicalTask* first = nullptr;
};

Parked& TheParked() {
  static Parked* const parked = new Parked;
  return *parked;
}

}  // namespace

LogicalTask::LogicalTask(std::size_t size) : stack_size(size) {
  if (size == 0) return;  // the stack of a pthread
  const auto stack =
      boost::context::protected_fixedsize_stack(size + kMostColors * kCacheLine)
          .allocate();
  annotations.Make();
  annotations.SetStack(static_cast<char*>(stack.sp) - stack.size, stack.size);
  const std::size_t skipped = NextColor() * kCacheLine;
  context = boost::context::detail::make_fcontext(
      static_cast<char*>(stack.sp) - skipped, stack.size - skipped,
      &LogicalProcessor::RunBodies);
}

void LogicalTask::RunBody() {
  record->SetRunning(number);
  if (!has_record_of_pthread) {
    RecordIf(TraceClass::kTasks, TraceAction::kTaskBegin, 0);
  }
  try {
    (*body)(index);
  } catch (...) {
    failure = std::current_exception();
  }
  if (!has_record_of_pthread) {
    RecordIf(TraceClass::kTasks, TraceAction::kTaskEnd, 0);
  }
}

std::size_t LogicalTask::WantedStackSize() {
  const std::size_t wanted = WorkerPool::TheOne().stack_size();
  return wanted == 0 ? kDefaultStackSize : wanted;
}

LogicalTask* LogicalTask::Take() {
  const std::size_t size = WantedStackSize();
  {
    Parked& parked = TheParked();
    const MutexGuard guard(parked.mutex);
    for (LogicalTask** place = &parked.first; *place != nullptr;
         place = &(*place)->next) {
      if ((*place)->stack_size != size) continue;
      return std::exchange(*place, (*place)->next);
    }
  }
  return new LogicalTask(size);
}

void LogicalTask::Give(LogicalTask* task) {
  Parked& parked = TheParked();
  const MutexGuard guard(parked.mutex);
  task->next = parked.first;
  parked.first = task;
}

LogicalTasks::LogicalTasks(int num_tasks) {
  tasks_.reserve(static_cast<std::size_t>(num_tasks));
  try {
    for (int task = 0; task < num_tasks; ++task) {
      tasks_.push_back(LogicalTask::Take());
    }
  } catch (const std::bad_alloc&) {
    const std::size_t num_there = tasks_.size();
    GiveAll();
    throw std::system_error(
        std::make_error_code(std::errc::not_enough_memory),
        "cannot start " + std::to_string(num_tasks) + " tasks with " +
            std::to_string(LogicalTask::WantedStackSize()) +
            " bytes of stack each, after " + std::to_string(num_there));
  }
}

void LogicalTasks::GiveAll() {
  for (LogicalTask* task : tasks_) LogicalTask::Give(task);
}

}  // namespace macrotask
