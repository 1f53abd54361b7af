#include "macrotask/cray/tasks.h"

#include <time.h>

#include <algorithm>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>

#include "macrotask/cray/tuning.h"
#include "macrotask/mutex.h"
#include "macrotask/task.h"

namespace macrotask::cray {
namespace {

// Never destroyed, because a task may never return.
struct Tasks {
  Mutex mutex;  // guards all below
  std::map<std::int64_t, std::shared_ptr<Task>> by_number;
  std::size_t num_to_sweep_at = 64;
};

Tasks& TheTasks() {
  static Tasks* const tasks = new Tasks;
  return *tasks;
}

// CPU time of the pthread when its task began, which is not its first.
constinit thread_local double cpu_seconds_at_begin = 0;

double CpuSecondsOfPthread() {
  timespec time;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) +
         static_cast<double>(time.tv_nsec) * 1e-9;
}

template <std::size_t... I>
void Apply(TaskRoutine routine, const Words& words, std::index_sequence<I...>) {
  using Called = void (*)(std::remove_cvref_t<decltype(words[I])>...);
  reinterpret_cast<Called>(routine)(words[I]...);
}

std::shared_ptr<Task> Find(std::int64_t number) {
  Tasks& tasks = TheTasks();
  const MutexGuard guard(tasks.mutex);
  const auto found = tasks.by_number.find(number);
  return found == tasks.by_number.end() ? nullptr : found->second;
}

// Forgets complete tasks, so seldom that it does not count.
void Sweep(Tasks* tasks) {
  if (tasks->by_number.size() < tasks->num_to_sweep_at) return;
  std::erase_if(tasks->by_number,
                [](const auto& entry) { return !entry.second->is_running(); });
  constexpr std::size_t kFewest = 64;
  tasks->num_to_sweep_at = std::max(kFewest, 2 * tasks->by_number.size());
}

}  // namespace

std::uint32_t StartTask(TaskRoutine routine, const Words& words,
                        std::uint64_t value) {
  if (routine == nullptr) {
    throw std::runtime_error("the routine to start is null");
  }
  const auto body = [routine, words] {
    cpu_seconds_at_begin = CpuSecondsOfPthread();
    Apply(routine, words, std::make_index_sequence<kMostWords>());
  };
  Tasks& tasks = TheTasks();
  const auto task = std::make_shared<Task>(
      body, TaskOptions{.wait = TunedPolicy(), .value = value});
  const MutexGuard guard(tasks.mutex);
  Sweep(&tasks);
  tasks.by_number[task->number()] = task;
  return task->number();
}

void WaitForTask(std::int64_t number) {
  const std::shared_ptr<Task> task = Find(number);
  if (task == nullptr) return;
  task->Wait();
  Tasks& tasks = TheTasks();
  const MutexGuard guard(tasks.mutex);
  tasks.by_number.erase(number);
}

bool TestTask(std::int64_t number) {
  const std::shared_ptr<Task> task = Find(number);
  return task != nullptr && task->Test();
}

double CpuSeconds() { return CpuSecondsOfPthread() - cpu_seconds_at_begin; }

template <typename Word>
std::uint64_t UserValueIn(const Word* tca) {
  const std::int64_t length = tca[0];
  if (length == 2) return 0;
  if (length == 3) return static_cast<std::make_unsigned_t<Word>>(tca[2]);
  throw std::runtime_error("the task control array says it has " +
                           std::to_string(length) +
                           " words: expected 2, or 3 with a user value");
}

template std::uint64_t UserValueIn<std::int32_t>(const std::int32_t*);
template std::uint64_t UserValueIn<std::int64_t>(const std::int64_t*);

}  // namespace macrotask::cray
