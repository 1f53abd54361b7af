#pragma once

#include <boost/context/detail/fcontext.hpp>
#include <cstdint>
#include <exception>
#include <functional>
#include <vector>

#include "macrotask/cache_line.h"
#include "macrotask/fiber_annotations.h"
#include "macrotask/task_record.h"

namespace macrotask {

class LogicalBarrier;
class LogicalProcessor;

// Internal: what the C++ runtime keeps for every pthread and would have to keep
// for every stack (__cxa_eh_globals of the Itanium C++ ABI).
struct ExceptionState {
  void* caught = nullptr;
  unsigned num_uncaught = 0;
};

// Internal: a task with a stack of its own that takes turns with others on one
// pthread (its logical processor). It is kept when its body has ended, parked at
// the end of a loop, for the next body.
struct alignas(kCacheLine) LogicalTask {
  // With a stack of so many bytes and a guard page; 0 for that of the caller.
  explicit LogicalTask(std::size_t stack_size);
  LogicalTask(const LogicalTask&) = delete;
  LogicalTask& operator=(const LogicalTask&) = delete;

  // Takes one with a stack of the size that is wanted now from those that are
  // parked, or makes one. Give() parks it again.
  static LogicalTask* Take();
  static void Give(LogicalTask* task);
  static std::size_t WantedStackSize();

  void RunBody();

  // For the same phase of the same barrier.
  bool WaitsLike(const LogicalTask& other) const {
    return barrier != nullptr && barrier == other.barrier &&
           end_of_phase == other.end_of_phase;
  }

  // What a turn needs comes first, on two lines.
  //
  // Where it goes on; not while it runs.
  boost::context::detail::fcontext_t context = nullptr;
  LogicalTask* next = nullptr;  // in the ring of its processor, or parked

  // Of its wait; none while is_over is null. At a LogicalBarrier it is over
  // once the barrier is past `end_of_phase`; `barrier` is null otherwise.
  TaskRecord::IsOver is_over = nullptr;
  const void* wait = nullptr;
  LogicalBarrier* barrier = nullptr;
  std::uint64_t end_of_phase = 0;
  const WaitedObject* what = nullptr;

  LogicalProcessor* processor = nullptr;
  TaskRecord* record = nullptr;
  std::uint32_t number = 0;

  // What the C++ runtime knows of the exceptions being handled on this stack.
  ExceptionState exceptions;

  // Of the body that it runs.
  const std::function<void(int)>* body = nullptr;
  int index = 0;
  bool has_record_of_pthread = false;  // that of the pthread's own task
  std::exception_ptr failure;

  LogicalTask* previous = nullptr;  // in the ring
  const std::size_t stack_size;
  FiberAnnotations annotations;
};

// Internal: so many logical tasks, for the length of a block.
class LogicalTasks {
 public:
  // Throws std::system_error, with a sentence, if there is no memory for their
  // stacks.
  explicit LogicalTasks(int num_tasks);
  ~LogicalTasks() { GiveAll(); }
  LogicalTasks(const LogicalTasks&) = delete;
  LogicalTasks& operator=(const LogicalTasks&) = delete;

  LogicalTask* operator[](int task) const {
    return tasks_[static_cast<std::size_t>(task)];
  }

 private:
  void GiveAll();

  std::vector<LogicalTask*> tasks_;
};

}  // namespace macrotask
