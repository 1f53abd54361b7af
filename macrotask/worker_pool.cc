#include "macrotask/worker_pool.h"

#include <limits.h>

#include <cstdlib>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

#include "macrotask/affinity.h"
#include "macrotask/busy_time.h"
#include "macrotask/check.h"
#include "macrotask/deadlock.h"
#include "macrotask/load.h"
#include "macrotask/program_end.h"
#include "macrotask/trace_point.h"

namespace macrotask {
namespace {

// pthread_attr_t that starts a pthread with the given affinity; otherwise it
// would inherit that of its creator, which may be a pinned task.
class PthreadAttributes {
 public:
  PthreadAttributes(int processor, std::size_t stack_size) {
    CheckPthread(pthread_attr_init(&attributes_), "pthread_attr_init");
    const cpu_set_t affinity = AffinityFor(processor);
    int error =
        pthread_attr_setaffinity_np(&attributes_, sizeof affinity, &affinity);
    if (error == 0 && stack_size != 0) {
      error = pthread_attr_setstacksize(&attributes_, stack_size);
    }
    if (error != 0) pthread_attr_destroy(&attributes_);
    CheckPthread(error, "pthread_attr_t of a task");
  }
  ~PthreadAttributes() { pthread_attr_destroy(&attributes_); }
  PthreadAttributes(const PthreadAttributes&) = delete;
  PthreadAttributes& operator=(const PthreadAttributes&) = delete;

  const pthread_attr_t* get() const { return &attributes_; }

 private:
  pthread_attr_t attributes_;
};

}  // namespace

void Job::Await() {
  if (done.Read() == 1) return;
  const WaitedObject task = {ObjectKind::kTask, number};
  if (wait.kind == WaitKind::kSpin) return done.AwaitPast(0, wait, task);
  const WaitPolicy policy = IdlePolicy(wait);
  const ScopedLeaveLoad no_live_task;
  done.AwaitPast(0, policy, task);
}

Worker::Worker(int processor, std::size_t stack_size)
    : record_(TaskRegistry::TheOne().Acquire()),
      stack_size_(stack_size),
      processor_(processor) {
  try {
    const PthreadAttributes attributes(processor, stack_size);
    CheckPthread(pthread_create(&pthread_, attributes.get(), &Main, this),
                 "pthread_create");
  } catch (...) {
    TaskRegistry::TheOne().Release(record_);
    throw;
  }
}

void* Worker::Main(void* worker) {
  auto* const self = static_cast<Worker*>(worker);
  TaskRegistry::Adopt(self->record_);
  NoteBusy(+1);
  self->RunJobs();
  NoteBusy(-1);
  return nullptr;
}

void Worker::Start(Job& job) noexcept {
  EnterLoad();
  job.number = NextTaskNumber();
  record_->SetReady(job.number, job.value);
  RecordIf(TraceClass::kTasks, TraceAction::kTaskStart, TraceData(job.number));
  job_ = &job;
  given_.Advance();
}

void Worker::Join() {
  job_ = nullptr;
  given_.Advance();
  CheckPthread(pthread_join(pthread_, nullptr), "pthread_join");
  TaskRegistry::TheOne().Release(record_);
}

void Worker::RunJobs() {
  WaitPolicy idle = WaitPolicy::Hold();
  for (std::uint64_t num_done = 0;; ++num_done) {
    given_.AwaitPast(num_done, idle);
    if (job_ == nullptr) return;
    idle = Run(*job_);
  }
}

// Returns how to wait for the next job.
WaitPolicy Worker::Run(Job& job) {
  const int version = AffinityVersion();
  if ((processor_ != job.processor || affinity_version_ != version) &&
      MoveCallerTo(job.processor)) {
    processor_ = job.processor;
    affinity_version_ = version;
  }
  record_->SetRunning(job.number);
  RecordIf(TraceClass::kTasks, TraceAction::kTaskBegin, job.value);
  try {
    const ScopedProcessorLoad shared(job.load);
    job.body();
  } catch (...) {
    job.failure = std::current_exception();
  }
  RecordIf(TraceClass::kTasks, TraceAction::kTaskEnd, 0);
  const WaitPolicy idle = IdlePolicy(job.wait);
  LeaveLoad();
  // Before the job is done: whoever waits for it and then starts the next one
  // shall find this worker idle, and not create another. The next job may
  // therefore be given before this one is done; it waits in job_.
  WorkerPool::TheOne().Return(this);
  job.done.Advance();
  record_->SetComplete();
  DetectDeadlock();
  return idle;
}

WorkerPool& WorkerPool::TheOne() {
  static WorkerPool* pool = [] {
    auto* const made = new WorkerPool;
    // A static object destroyed after this may still start tasks: the pool is
    // then as empty as at the beginning, and its pthreads end with the process.
    std::atexit([] { TheOne().JoinIdle(); });
    return made;
  }();
  return *pool;
}

Worker* WorkerPool::Acquire(int processor) {
  if (Worker* const idle = TakeIdle(processor)) return idle;
  std::size_t stack_size;
  {
    const MutexGuard guard(mutex_);
    stack_size = stack_size_;
  }
  auto made = std::make_unique<Worker>(processor, stack_size);
  const MutexGuard guard(mutex_);
  ++num_workers_;
  return made.release();
}

void WorkerPool::SetStackSize(std::size_t bytes) {
  if (bytes != 0 && bytes < static_cast<std::size_t>(PTHREAD_STACK_MIN)) {
    throw std::invalid_argument("a stack of " + std::to_string(bytes) +
                                " bytes: expected at least " +
                                std::to_string(PTHREAD_STACK_MIN));
  }
  const MutexGuard guard(mutex_);
  stack_size_ = bytes;
}

std::size_t WorkerPool::stack_size() const {
  const MutexGuard guard(mutex_);
  return stack_size_;
}

// Returns an idle worker with the stack that is wanted now, the first on
// `processor` if there is one, or null.
Worker* WorkerPool::TakeIdle(int processor) {
  const MutexGuard guard(mutex_);
  Worker** taken = nullptr;
  for (Worker** place = &idle_; *place != nullptr;
       place = &(*place)->next_idle_) {
    if ((*place)->stack_size_ != stack_size_) continue;
    if (taken == nullptr) taken = place;
    if ((*place)->processor_ != processor) continue;
    taken = place;
    break;
  }
  return taken == nullptr ? nullptr
                          : std::exchange(*taken, (*taken)->next_idle_);
}

Worker* WorkerPool::TakeAnyIdle() {
  const MutexGuard guard(mutex_);
  return idle_ == nullptr ? nullptr : std::exchange(idle_, idle_->next_idle_);
}

void WorkerPool::Return(Worker* worker) {
  const MutexGuard guard(mutex_);
  worker->next_idle_ = idle_;
  idle_ = worker;
}

void WorkerPool::JoinIdle() {
  if (caller_stops_program)
    return;  // It may be one of them that stops the program.
  while (Worker* const worker = TakeAnyIdle()) {
    const std::unique_ptr<Worker> joined(worker);
    joined->Join();
    const MutexGuard guard(mutex_);
    --num_workers_;
  }
}

int WorkerPool::num_workers() const {
  const MutexGuard guard(mutex_);
  return num_workers_;
}

}  // namespace macrotask
