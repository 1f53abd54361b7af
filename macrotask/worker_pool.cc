#include "macrotask/worker_pool.h"

#include <cstdlib>
#include <memory>

#include "macrotask/affinity.h"
#include "macrotask/check.h"
#include "macrotask/load.h"

namespace macrotask {
namespace {

constinit thread_local std::uint64_t user_value = 0;

// pthread_attr_t that starts a pthread with the given affinity; otherwise it
// would inherit that of its creator, which may be a pinned task.
class PthreadAttributes {
 public:
  explicit PthreadAttributes(int processor) {
    CheckPthread(pthread_attr_init(&attributes_), "pthread_attr_init");
    const cpu_set_t affinity = AffinityFor(processor);
    const int error =
        pthread_attr_setaffinity_np(&attributes_, sizeof affinity, &affinity);
    if (error != 0) pthread_attr_destroy(&attributes_);
    CheckPthread(error, "pthread_attr_setaffinity_np");
  }
  ~PthreadAttributes() { pthread_attr_destroy(&attributes_); }
  PthreadAttributes(const PthreadAttributes&) = delete;
  PthreadAttributes& operator=(const PthreadAttributes&) = delete;

  const pthread_attr_t* get() const { return &attributes_; }

 private:
  pthread_attr_t attributes_;
};

}  // namespace

std::uint64_t UserValueOfCaller() { return user_value; }

void Job::Await() {
  if (done.Read() == 1) return;
  if (wait.kind == WaitKind::kSpin) return done.AwaitPast(0, wait);
  const WaitPolicy policy = IdlePolicy(wait);
  const ScopedLeaveLoad no_live_task;
  done.AwaitPast(0, policy);
}

Worker::Worker(int processor) : processor_(processor) {
  const PthreadAttributes attributes(processor);
  CheckPthread(pthread_create(&pthread_, attributes.get(), &Main, this),
               "pthread_create");
}

void* Worker::Main(void* worker) {
  static_cast<Worker*>(worker)->RunJobs();
  return nullptr;
}

void Worker::Start(Job& job) noexcept {
  EnterLoad();
  job_ = &job;
  given_.Advance();
}

void Worker::Join() {
  job_ = nullptr;
  given_.Advance();
  CheckPthread(pthread_join(pthread_, nullptr), "pthread_join");
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
  if (processor_ != job.processor && MoveCallerTo(job.processor)) {
    processor_ = job.processor;
  }
  user_value = job.value;
  try {
    job.body();
  } catch (...) {
    job.failure = std::current_exception();
  }
  const WaitPolicy idle = IdlePolicy(job.wait);
  LeaveLoad();
  // Before the job is done: whoever waits for it and then starts the next one
  // shall find this worker idle, and not create another. The next job may
  // therefore be given before this one is done; it waits in job_.
  WorkerPool::TheOne().Return(this);
  job.done.Advance();
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
  auto made = std::make_unique<Worker>(processor);
  const MutexGuard guard(mutex_);
  ++num_workers_;
  return made.release();
}

// Returns an idle worker, the first on `processor` if there is one, or null.
Worker* WorkerPool::TakeIdle(int processor) {
  const MutexGuard guard(mutex_);
  if (idle_ == nullptr) return nullptr;
  Worker** place = &idle_;
  while (*place != nullptr && (*place)->processor_ != processor) {
    place = &(*place)->next_idle_;
  }
  if (*place == nullptr) place = &idle_;
  Worker* const taken = *place;
  *place = taken->next_idle_;
  return taken;
}

void WorkerPool::Return(Worker* worker) {
  const MutexGuard guard(mutex_);
  worker->next_idle_ = idle_;
  idle_ = worker;
}

void WorkerPool::JoinIdle() {
  while (Worker* const worker = TakeIdle(kAnyProcessor)) {
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
