#include "macrotask/task.h"

#include <exception>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "macrotask/affinity.h"
#include "macrotask/load.h"
#include "macrotask/logical_processor.h"
#include "macrotask/logical_wait.h"
#include "macrotask/processor_load.h"
#include "macrotask/program_end.h"
#include "macrotask/task_registry.h"
#include "macrotask/trace_point.h"

namespace macrotask {
namespace {

// std::system_error whose text is one sentence, which the standard one would
// end with a colon and the name of the error.
class CannotStartTasks : public std::system_error {
 public:
  CannotStartTasks(int num_tasks, int num_threads, std::error_code code)
      : std::system_error(code),
        text_("cannot start " + std::to_string(num_tasks) +
              (num_tasks == 1 ? " task" : " tasks") +
              ": the system allows no more threads after " +
              std::to_string(num_threads) + " (" + code.message() + ")") {}

  const char* what() const noexcept override { return text_.c_str(); }

 private:
  std::string text_;
};

Worker* AcquireForTask(int processor) {
  WorkerPool& pool = WorkerPool::TheOne();
  try {
    return pool.Acquire(processor);
  } catch (const std::system_error& error) {
    if (error.code() != std::errc::resource_unavailable_try_again) throw;
    throw CannotStartTasks(1, pool.num_workers() + 1, error.code());
  }
}

// Returns workers for the tasks 1 .. num_tasks - 1, or throws and gives those
// obtained back to the system.
std::vector<Worker*> AcquireForTasks(const std::vector<int>& processors) {
  WorkerPool& pool = WorkerPool::TheOne();
  std::vector<Worker*> workers;
  workers.reserve(processors.size());
  try {
    for (std::size_t task = 1; task < processors.size(); ++task) {
      workers.push_back(pool.Acquire(processors[task]));
    }
  } catch (const std::system_error& error) {
    const int num_threads = pool.num_workers() + 1;
    for (Worker* worker : workers) pool.Return(worker);
    pool.JoinIdle();
    if (error.code() != std::errc::resource_unavailable_try_again) throw;
    throw CannotStartTasks(static_cast<int>(processors.size()), num_threads,
                           error.code());
  } catch (...) {
    for (Worker* worker : workers) pool.Return(worker);
    throw;
  }
  return workers;
}

// Where each task goes, and which of those that share a processor it belongs
// to.
struct Places {
  std::vector<int> processors;
  std::vector<ProcessorLoad*> loads;
};
Places PlacesOf(const Placement& placement) {
  const auto num_tasks = static_cast<std::size_t>(placement.num_tasks());
  Places places = {std::vector<int>(num_tasks, kAnyProcessor),
                   std::vector<ProcessorLoad*>(num_tasks, nullptr)};
  // Other tasks would share the processors and be as many more in their way.
  const bool alone = load.num_tasks.load(std::memory_order_relaxed) == 1;
  for (std::size_t i = 0; alone && i < num_tasks; ++i) {
    const int task = static_cast<int>(i);
    places.processors[i] = placement.processor(task);
    if (placement.is_crowded()) {
      places.loads[i] = &LoadOfProcessor(placement.index(task));
    }
  }
  return places;
}

}  // namespace

Task::Task(std::function<void()> body, TaskOptions options)
    : job_{.body = std::move(body),
           .wait = options.wait,
           .processor = options.processor,
           .value = options.value,
           .failure = {},
           .done = {}} {
  if (!job_.body) throw std::invalid_argument("a task needs a body");
  if (options.processor != kAnyProcessor && !IsUsable(options.processor)) {
    throw std::invalid_argument("processor " +
                                std::to_string(options.processor) +
                                " is none that this process may use");
  }
  AcquireForTask(options.processor)->Start(job_);
}

Task::~Task() {
  // It may be one of those in a deadlock.
  if (!caller_stops_program) job_.Await();
}

void Task::Wait() {
  RecordAround(TraceClass::kTasks, TraceAction::kTaskWait,
               TraceAction::kTaskWaitEnd, TraceData(job_.number),
               [this] { job_.Await(); });
  if (job_.failure) std::rethrow_exception(job_.failure);
}

bool Task::Test() const {
  const bool runs = is_running();
  RecordIf(TraceClass::kTasks, TraceAction::kTaskTest,
           TraceData(job_.number, runs ? 1 : 0));
  if (runs && processor_of_caller != nullptr) GiveWay();
  return runs;
}

std::uint64_t Task::Value() {
  return record_of_caller != nullptr ? record_of_caller->value() : 0;
}

void RunTasks(int num_tasks, const std::function<void(int)>& body,
              WaitPolicy wait) {
  const Placement placement(num_tasks);
  wait = wait.For(num_tasks);
  if (!body) throw std::invalid_argument("tasks need a body");
  if (wait.kind == WaitKind::kLogical) {
    if (processor_of_caller == nullptr) return RunLogicalTasks(num_tasks, body);
    wait = WaitPolicy::Hold();  // within a logical task
  }
  const Places places = PlacesOf(placement);

  // Everything that can fail comes before the first start.
  std::vector<Job> jobs(places.processors.size() - 1);
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    const int task = static_cast<int>(i) + 1;
    jobs[i].body = [&body, task] { body(task); };
    jobs[i].wait = wait;
    jobs[i].processor = places.processors[i + 1];
    jobs[i].load = places.loads[i + 1];
  }
  const std::vector<Worker*> workers = AcquireForTasks(places.processors);

  const ScopedProcessor on_own_processor(places.processors[0]);
  for (ProcessorLoad* shared : places.loads) {
    if (shared != nullptr) shared->Add(+1);
  }
  for (std::size_t i = 0; i < jobs.size(); ++i) workers[i]->Start(jobs[i]);
  std::exception_ptr failure;
  try {
    const ScopedProcessorLoad shared(places.loads[0]);
    body(0);
  } catch (...) {
    failure = std::current_exception();
  }
  for (Job& job : jobs) {
    RecordAround(TraceClass::kTasks, TraceAction::kTaskWait,
                 TraceAction::kTaskWaitEnd, TraceData(job.number),
                 [&] { job.Await(); });
    if (!failure) failure = job.failure;
  }
  if (failure) std::rethrow_exception(failure);
}

}  // namespace macrotask
