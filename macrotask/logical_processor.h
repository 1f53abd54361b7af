#pragma once

#include <functional>
#include <vector>

#include "macrotask/logical_slot.h"
#include "macrotask/logical_task.h"
#include "macrotask/wait_policy.h"

namespace macrotask {

class LogicalBarrier;

// Internal: a pthread that runs several tasks by turns, in user space. A task
// that waits gives way to the next one that can go on; nobody is interrupted.
//
// Use: everything by tasks of this processor, or by the pthread itself before
// and after Run().
// Memory ordering: tasks of one processor see what the others wrote before.
// Cost: a turn is a switch of stacks and a look at what the next task waits for
// (bench row "BARSYNC").
class LogicalProcessor {
 public:
  LogicalProcessor() = default;
  LogicalProcessor(const LogicalProcessor&) = delete;
  LogicalProcessor& operator=(const LogicalProcessor&) = delete;

  // Adds `task`, which is to run body(index), before Run(). The first one is
  // given the record and the number of the pthread.
  void Add(LogicalTask* task, const std::function<void(int)>& body, int index);

  // Runs all tasks until they have ended. Returns what the first of them, in
  // the order in which they were added, has thrown.
  std::exception_ptr Run();

  // Returns when the wait of the calling task is over. As TaskRecord's
  // BeginWait(); others run meanwhile.
  void Wait(const WaitedObject& what, TaskRecord::IsOver is_over,
            const void* wait);

  // The same, for the barrier to be past the end of a phase.
  void WaitAt(LogicalBarrier& barrier, std::uint64_t end_of_phase,
              const WaitedObject& what);

  // Lets the next task that can go on have a turn.
  void Yield();

  // Calls Publish() of the barrier before this processor has nothing to
  // do.
  void FlushLater(LogicalBarrier* barrier) { unflushed_.push_back(barrier); }
  void IsFlushed(LogicalBarrier* barrier) { std::erase(unflushed_, barrier); }

  int slot() const { return slot_.number(); }

 private:
  friend struct LogicalTask;

  using Stack = boost::context::detail::fcontext_t;

  // What a task does on its own stack, for ever. `from` is who switched to it
  // first, with the task.
  static void RunBodies(boost::context::detail::transfer_t from);
  void Arrive(Stack from);
  void SwitchTo(LogicalTask* task);
  void Finish();
  bool IsOver(const LogicalTask& task) const;
  LogicalTask* FindRunnable(LogicalTask* first,
                            LogicalTask** one_for_all) const;
  LogicalTask* NextTurn(LogicalTask* first);
  LogicalTask* AwaitRunnable(LogicalTask* first, LogicalTask* one_for_all);
  void PublishWaits();
  void EndWaits();
  void Flush();
  void RecordWaitForNeighbours();

  const LogicalSlot slot_;
  std::vector<LogicalTask*> tasks_;  // in the order of Add()
  LogicalTask* current_ = nullptr;
  LogicalTask* previous_ = nullptr;       // who switched to current_
  LogicalTask pthread_{0};                // the stack that called Run()
  int num_left_ = 0;                      // in the ring
  ExceptionState* exceptions_ = nullptr;  // those of the pthread
  int num_turns_ = 0;                     // since the last Flush()
  bool waits_are_published_ = false;
  bool waits_for_neighbours_ = false;  // the first task, in the history trace
  std::vector<LogicalBarrier*> unflushed_;
};

// Runs body(0) ... body(num_tasks - 1) by turns on up to NumProcessors()
// pthreads, the caller's among them, neighbours together. As RunTasks() with
// WaitPolicy::Logical(), which is this. Throws std::system_error, with nothing
// started, if there is no memory for so many stacks.
void RunLogicalTasks(int num_tasks, const std::function<void(int)>& body);

}  // namespace macrotask
