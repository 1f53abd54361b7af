#include "macrotask/task_registry.h"

#include <pthread.h>
#include <unistd.h>

#include "macrotask/busy_time.h"
#include "macrotask/check.h"
#include "macrotask/deadlock.h"
#include "macrotask/mutex.h"

namespace macrotask {
namespace {

Mutex& RegistryMutex() {
  static Mutex* const mutex = new Mutex;
  return *mutex;
}

// Gives the record of a pthread that is not ours back when the pthread ends. A
// key, because a thread_local's destructor also runs in std::exit(), of whose
// caller one may not say that it runs no more.
void ReleaseAtPthreadEnd(void* record) {
  auto* const mine = static_cast<TaskRecord*>(record);
  mine->SetComplete();
  DetectDeadlock();
  NoteBusy(-1);
  // The destructor of another key may wait, by a record of its own.
  record_of_caller = nullptr;
  number_of_caller = 0;
  TaskRegistry::TheOne().Release(mine);
}

pthread_key_t KeyOfForeignRecords() {
  static const pthread_key_t key = [] {
    pthread_key_t made;
    CheckPthread(pthread_key_create(&made, &ReleaseAtPthreadEnd),
                 "pthread_key_create");
    return made;
  }();
  return key;
}

// The pthread that loads the library is the initial task, running from the
// start: else another one could believe that it is alone.
[[maybe_unused]] const std::uint32_t initial_task = RecordOfCaller().number();

constexpr std::uint32_t kMostNumber = 0x7fffffff;  // fits a 32-bit integer

}  // namespace

std::uint32_t NextTaskNumber() {
  static constinit std::atomic<std::uint32_t> last{0};
  for (;;) {
    const std::uint32_t number =
        (last.fetch_add(1, std::memory_order_relaxed) + 1) & kMostNumber;
    if (number != 0) return number;
  }
}

TaskRegistry& TaskRegistry::TheOne() {
  static TaskRegistry* const registry = new TaskRegistry;
  return *registry;
}

TaskRecord* TaskRegistry::Acquire() {
  const MutexGuard guard(RegistryMutex());
  TaskRecord* record = free_;
  if (record != nullptr) {
    free_ = record->next_free_;
    return record;
  }
  record = new TaskRecord;
  record->next_ = first_.load(std::memory_order_relaxed);
  // Release: partner of the acquire in first().
  first_.store(record, std::memory_order_release);
  return record;
}

void TaskRegistry::Release(TaskRecord* record) {
  // It keeps the pthread's number, for the system lists that one a little
  // longer.
  const MutexGuard guard(RegistryMutex());
  record->next_free_ = free_;
  free_ = record;
}

void TaskRegistry::Adopt(TaskRecord* record) {
  // Release: partner of the acquire in pthread_id(). Whoever takes the pthread
  // for a known one also sees the task that it runs.
  record->pthread_id_.store(gettid(), std::memory_order_release);
  record_of_caller = record;
}

TaskRecord& RegisterCaller() {
  const std::uint32_t number = NextTaskNumber();
  TaskRecord* const record = TaskRegistry::TheOne().Acquire();
  record->SetReady(number, 0);
  record->SetRunning(number);
  TaskRegistry::Adopt(record);
  NoteBusy(+1);
  CheckPthread(pthread_setspecific(KeyOfForeignRecords(), record_of_caller),
               "pthread_setspecific");
  return *record_of_caller;
}

}  // namespace macrotask
