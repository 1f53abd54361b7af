#include "macrotask/logical_task.h"

#include <boost/context/protected_fixedsize_stack.hpp>
#include <utility>

#include "macrotask/logical_processor.h"
#include "macrotask/mutex.h"
#include "macrotask/task_registry.h"
#include "macrotask/trace_point.h"
#include "macrotask/worker_pool.h"

namespace macrotask {
namespace {

constexpr std::size_t kDefaultStackSize = std::size_t{1} << 20;

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
  const auto stack = boost::context::protected_fixedsize_stack(size).allocate();
  annotations.Make();
  annotations.SetStack(static_cast<char*>(stack.sp) - stack.size, stack.size);
  context = boost::context::detail::make_fcontext(stack.sp, stack.size,
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

LogicalTask* LogicalTask::Take() {
  const std::size_t wanted = WorkerPool::TheOne().stack_size();
  const std::size_t size = wanted == 0 ? kDefaultStackSize : wanted;
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

}  // namespace macrotask
