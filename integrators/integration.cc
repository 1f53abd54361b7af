#include "integrators/integration.h"

#include <charconv>
#include <chrono>
#include <cmath>
#include <exception>
#include <stdexcept>
#include <string>
#include <utility>

#include "macrotask/barrier.h"
#include "macrotask/task.h"

namespace integrators {
namespace {

// Returns `options` if they suit the system; throws otherwise.
const IntegrationOptions& Checked(const System& system,
                                  const IntegrationOptions& options) {
  const auto [m, p] = options.partition;
  const auto check = [](bool good, const std::string& sentence) {
    if (!good) throw std::invalid_argument(sentence);
  };
  check(m >= 1 && m <= system.num_chains(),
        std::to_string(m) + " chain tasks: expected 1 to " +
            std::to_string(system.num_chains()) + ", the number of chains");
  check(p >= 1 && p <= options.method.block_size,
        std::to_string(p) + " integration tasks: expected 1 to " +
            std::to_string(options.method.block_size) +
            ", the points of a block of " + options.method.name());
  check(options.step > 0, "the step must be positive");
  CheckNumSteps(options.method, options.num_steps);
  return options;
}

// The shortest text that reads back as x.
std::string ToText(double x) {
  char text[32];
  const auto result = std::to_chars(text, text + sizeof text, x);
  return std::string(text, result.ptr);
}

double SecondsSince(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start)
      .count();
}

}  // namespace

int CountSteps(double duration, double step) {
  if (!(step > 0)) {
    throw std::invalid_argument("the step must be positive, not " +
                                ToText(step) + " s");
  }
  const double steps = std::round(duration / step);
  if (!(steps >= 1) || std::abs(steps * step - duration) > 1e-9 * step) {
    throw std::invalid_argument("the step of " + ToText(step) +
                                " s does not divide the duration of " +
                                ToText(duration) + " s");
  }
  constexpr double kMaxSteps = 1e6;  // the tables of a run are in memory
  if (steps > kMaxSteps) {
    throw std::invalid_argument("the step of " + ToText(step) +
                                " s makes more than a million steps");
  }
  return static_cast<int>(steps);
}

void CheckNumSteps(const BlockMethod& method, int num_steps) {
  const int needed = method.num_values - 1 + method.block_size;
  if (num_steps >= needed) return;
  throw std::invalid_argument(std::to_string(num_steps) +
                              " steps: " + method.name() + " needs at least " +
                              std::to_string(needed));
}

Integration::Integration(std::unique_ptr<System> system,
                         const IntegrationOptions& options)
    : system_(std::move(system)),
      wait_(options.wait.For(options.partition.num_tasks())),
      run_(*system_, Checked(*system_, options).method, options.step,
           options.num_steps, options.partition, RmaSharingOf(options.figure)),
      start_(*system_),
      factory_(system_->MakeFactory(options.method.block_size)),
      figure_(options.figure),
      on_begin_(options.on_begin),
      on_end_(options.on_end) {
  MakeTaskStructure(figure_, options.partition, wait_);
  // Each task allocates its own work space, so that no two share a cache line:
  // the allocator serves every pthread from an arena of its own.
  tasks_.resize(static_cast<std::size_t>(options.partition.num_tasks()));
  const int m = options.partition.chain_tasks;
  macrotask::RunTasks(
      options.partition.num_tasks(),
      [&](int task) {
        tasks_[static_cast<std::size_t>(task)] = std::make_unique<BlockTask>(
            &run_, task / m, task % m, factory_.get());
      },
      wait_);
  if (options.record) {
    trajectory_.resize((static_cast<std::size_t>(options.num_steps) + 1) *
                       run_.layout.size());
    run_.trajectory = trajectory_.data();
  }
}

template <typename StartFunction>
IntegrationResult Integration::RunTasks(StartFunction start) {
  const Partition partition = run_.partition;
  const auto structure = MakeTaskStructure(figure_, partition, wait_);
  macrotask::Barrier all(partition.num_tasks(), wait_);
  IntegrationResult result;
  std::exception_ptr start_error;

  const auto body = [&](int task) {
    all.Sync();  // all tasks are there
    const auto begin = std::chrono::steady_clock::now();
    if (on_begin_) on_begin_(task);
    if (task == 0) {
      // The others wait for the start: an exception must not pass them by.
      try {
        result.evaluations = start();
      } catch (...) {
        start_error = std::current_exception();
      }
      result.start_seconds = SecondsSince(begin);
    }
    all.Sync();
    if (start_error) return;
    structure->Run(task / partition.chain_tasks, task % partition.chain_tasks,
                   *tasks_[static_cast<std::size_t>(task)]);
    all.Sync();
    if (on_end_) on_end_(task);
    if (task == 0) {
      result.block_seconds = SecondsSince(begin) - result.start_seconds;
    }
  };
  macrotask::RunTasks(partition.num_tasks(), body, wait_);

  if (start_error) std::rethrow_exception(start_error);
  std::exception_ptr user_error;
  for (const auto& task : tasks_) {
    const std::exception_ptr error = task->TakeError();
    if (!user_error) user_error = error;
  }
  if (user_error) std::rethrow_exception(user_error);
  if (const Failure failure = run_.FirstFailure(); failure.code != 0) {
    throw IntegrationError(system_->DescribeFailure(failure.code),
                           failure.time);
  }
  result.state.resize(run_.layout.size());
  for (Column& column : run_.columns) {
    run_.CopyToFull(column, column.y(column.place(), 0).data(),
                    result.state.data());
  }
  result.evaluations += 2LL * run_.num_blocks * run_.method.block_size;
  return result;
}

IntegrationResult Integration::Run(const std::vector<double>& y0) {
  if (y0.size() != run_.layout.size()) {
    throw std::invalid_argument(
        "the initial state has " + std::to_string(y0.size()) +
        " numbers: expected " + std::to_string(run_.layout.size()));
  }
  return RunTasks([&] { return start_.Dopri5(y0.data(), &run_); });
}

IntegrationResult Integration::RunFrom(const ExactValues& values) {
  return RunTasks([&] { return start_.Exact(values, &run_); });
}

}  // namespace integrators
