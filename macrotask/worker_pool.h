#pragma once

#include <pthread.h>

#include <cstdint>
#include <exception>
#include <functional>

#include "macrotask/affinity.h"
#include "macrotask/epoch.h"
#include "macrotask/mutex.h"
#include "macrotask/placement.h"
#include "macrotask/processor_load.h"
#include "macrotask/task_registry.h"
#include "macrotask/wait_policy.h"

namespace macrotask {

// Internal: what a Worker runs for a task, and what became of it. Lives with
// the one who waits for the task.
struct Job {
  std::function<void()> body;
  WaitPolicy wait;                // of the tasks that wait for this one
  int processor = kAnyProcessor;  // where the body runs
  // Of the processor that it shares with others of a RunTasks(), where it has
  // been counted; null if it shares none.
  ProcessorLoad* load = nullptr;
  std::uint64_t value = 0;     // the user value, Task::Value() in the body
  std::uint32_t number = 0;    // of the task; set by Worker::Start()
  std::exception_ptr failure;  // what the body threw; valid once done is 1
  Epoch done;                  // 0: not complete, 1: complete

  // Returns when the body has ended. The caller is no live task meanwhile.
  void Await();
};

// Internal: a pthread that runs one job after the other and holds its processor
// for a while in between, so that the next one can start without a system call.
class Worker {
 public:
  // Creates the pthread, on `processor` and with a stack of `stack_size` bytes
  // (0: the system's default). Throws std::system_error.
  Worker(int processor, std::size_t stack_size);
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

  // Runs `job`, which must live until it is done. Requires: the worker is idle
  // and was acquired by the caller.
  void Start(Job& job) noexcept;

  // Ends and joins the pthread. Requires: as Start().
  void Join();

 private:
  friend class WorkerPool;
  static void* Main(void* worker);
  void RunJobs();
  WaitPolicy Run(Job& job);

  pthread_t pthread_;
  TaskRecord* const record_;
  const std::size_t stack_size_;
  int processor_;  // the affinity of the pthread now,
  int affinity_version_ = AffinityVersion();  // as this version has it
  Job* job_ = nullptr;           // written before given_, null: end
  Epoch given_;                  // number of jobs given
  Worker* next_idle_ = nullptr;  // guarded by the pool's mutex
};

// Internal: the idle workers of this process. Those that are idle at the end of
// the process are joined; one that still runs a body (a task may never return)
// is left to its fate. Never destroyed, because such a task may come back to
// it.
class WorkerPool {
 public:
  static WorkerPool& TheOne();

  // Returns an idle worker, if possible one that is on `processor` already, or
  // a new one. Throws std::system_error if the system refuses to create it.
  Worker* Acquire(int processor);

  // Stack of the pthreads that tasks get from now on, in bytes; 0: the system's
  // default. Throws std::invalid_argument if the system allows none so small.
  //
  // Cray name: STACKSZ, a keyword of TSKTUNE.
  void SetStackSize(std::size_t bytes);
  std::size_t stack_size() const;

  // Makes an acquired worker idle.
  void Return(Worker* worker);

  // Joins and forgets all idle workers.
  void JoinIdle();

  // Number of workers that exist, idle or not.
  int num_workers() const;

 private:
  Worker* TakeIdle(int processor);
  Worker* TakeAnyIdle();

  mutable Mutex mutex_;     // guards all below
  Worker* idle_ = nullptr;  // the last to become idle first: it still spins
  int num_workers_ = 0;
  std::size_t stack_size_ = 0;
};

}  // namespace macrotask
