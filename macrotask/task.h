#pragma once

#include <cstdint>
#include <functional>

#include "macrotask/placement.h"
#include "macrotask/wait_policy.h"
#include "macrotask/worker_pool.h"

namespace macrotask {

struct TaskOptions {
  WaitPolicy wait = {};           // how others wait for the task
  int processor = kAnyProcessor;  // where it runs
  std::uint64_t value = 0;        // what Value() returns in it
};

// A piece of work that runs beside its starter, from the constructor until its
// body ends.
//
// Cray name: TSKSTART (constructor), TSKWAIT, TSKTEST, TSKVALUE.
// Use: any task may start tasks, wait for them (several for one, twice is fine)
// and test them; a task that waits for itself waits for ever. The task must
// outlive the last return from any of its functions.
// Memory ordering: what the starter wrote before is visible to the body; what
// the body wrote is visible to every task whose Wait() returns or whose Test()
// returns false.
// Cost: a start on a pthread that still holds its processor from the task
// before makes no system call; one that sleeps is woken; the first ones are
// created (bench row "TSKSTART + TSKWAIT").
//
//   double left = 0;
//   Task task([&] { left = Sum(0, n / 2); });
//   double right = Sum(n / 2, n);
//   task.Wait();  // left + right
class Task {
 public:
  // Starts `body`. Throws std::system_error if the system allows no more
  // threads, std::invalid_argument if the processor is none that this process
  // may use or `body` is empty; then nothing runs.
  explicit Task(std::function<void()> body, TaskOptions options = {});

  // Waits for the body to end. An exception that nobody waited for is dropped.
  ~Task();
  Task(const Task&) = delete;
  Task& operator=(const Task&) = delete;

  // Returns when the body has ended. Throws what the body threw, to every task
  // that waits and every time.
  void Wait();

  // True iff the body has not ended yet.
  bool Test() const;

  // The same without an entry in the history trace.
  bool is_running() const { return job_.done.Read() == 0; }

  // The user value of the calling task: TaskOptions::value, 0 in the initial
  // task.
  static std::uint64_t Value();

  // Of this task in lists and traces; the initial task has 1.
  std::uint32_t number() const { return job_.number; }

 private:
  Job job_;
};

// Runs body(0) .. body(num_tasks - 1), one task each, of which the caller is
// task 0; returns when all have ended. `wait` says how the caller waits for
// them and how long their pthreads are held afterwards.
//
// Cray name: TSKSTART for the others, TSKWAIT at the end.
// Use: the tasks may use barriers among themselves: all pthreads are obtained
// before any body starts. They are pinned as Placement(num_tasks) says, unless
// other tasks are live (as in a RunTasks() within a task), which would share
// those processors; the caller's affinity is restored at the end. A body that
// throws while others wait for it at a barrier leaves them waiting for ever.
// With more tasks than processors they take turns in user space (WaitPolicy
// says what that means for a body), unless `wait` names another way.
// Memory ordering: as if each task were started and waited for by the caller.
// Failure: throws what the lowest-numbered task that threw has thrown;
// std::invalid_argument if `num_tasks` < 1; std::system_error, with nothing
// started, if the system allows too few threads.
// Cost: bench row "TSKSTART + TSKWAIT".
//
//   Barrier barrier(4);
//   RunTasks(4, [&](int task) {
//     Predict(task);
//     barrier.Sync();
//     Correct(task); });
void RunTasks(int num_tasks, const std::function<void(int)>& body,
              WaitPolicy wait = {});

}  // namespace macrotask
