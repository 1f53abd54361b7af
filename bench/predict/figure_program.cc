#include "bench/predict/figure_program.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <stdexcept>
#include <utility>
#include <vector>

#include "bench/breakdown.h"
#include "bench/predict/marked_system.h"
#include "bench/predict/step_reader.h"
#include "integrators/integration.h"
#include "macrotask/trace.h"

namespace bench::predict {
namespace {

using integrators::Integration;

// A system of that many chains which computes nothing.
class EmptySystem {
 public:
  explicit EmptySystem(int num_chains) : num_chains_(num_chains) {}

  int num_chains() const { return num_chains_; }
  int chain_size(int /*k*/) const { return 1; }
  int common_size() const { return 1; }
  int coupling_size() const { return 1; }
  struct Exchange {};
  Exchange MakeExchange(int /*num_points*/) const { return {}; }
  struct Evaluator {
    void Ocd(int, std::span<const double>, std::span<const double* const>) {}
    void Rma(int, std::span<const double* const>, std::span<double* const>,
             double*, std::span<int> failures) {
      std::fill(failures.begin(), failures.end(), 0);
    }
    void Ccd(const double*, std::span<double* const>) {}
    std::exception_ptr TakeError() { return {}; }
  };
  Evaluator MakeEvaluator(int, int, int, int, Exchange*) const { return {}; }
  std::string DescribeFailure(int) const { return "nothing can fail"; }

 private:
  int num_chains_;
};

constexpr int kBlocksRead = 3;

std::vector<std::vector<Step>> ReadSteps(const FigureCase& figure_case,
                                         int num_blocks, Program* program) {
  const EmptySystem empty(figure_case.num_chains);
  const SystemWith system(empty, {.marks = true});
  const integrators::BlockMethod& method = figure_case.method;
  Integration integration(system, {.method = method,
                                   .step = 1,
                                   .num_steps = method.num_values - 1 +
                                                num_blocks * method.block_size,
                                   .figure = figure_case.figure,
                                   .partition = figure_case.partition,
                                   .wait = macrotask::WaitPolicy::Logical(),
                                   .on_begin = &RecordBegin,
                                   .on_end = &RecordEnd});
  using macrotask::TraceClass;
  macrotask::SetTraceClasses(static_cast<std::uint32_t>(TraceClass::kEvents) |
                             static_cast<std::uint32_t>(TraceClass::kUsers));
  integration.RunFrom([](int, double*, double*) {});
  macrotask::SetTraceClasses(0);
  const RunRecords records = RecordsOfLastRun(
      macrotask::TakeTrace(), figure_case.partition.num_tasks());
  StepReader reader(1, 0, {});
  std::vector<std::vector<Step>> tasks;
  for (const auto& task : records) tasks.push_back(reader.Read(task));
  reader.TakeObjects(program);
  return tasks;
}

bool IsCompute(const Step& step, Block block) {
  return step.kind == StepKind::kCompute && step.block == block;
}

// A block of the method has two CS, and begins with the first of them.
TaskProgram Fold(std::vector<Step> steps, int num_blocks) {
  TaskProgram task;
  if (num_blocks <= kBlocksRead) {
    task.head = std::move(steps);
    return task;
  }
  std::vector<std::ptrdiff_t> begins;
  bool predicts = true;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    if (!IsCompute(steps[i], Block::kCs)) continue;
    if (predicts) begins.push_back(static_cast<std::ptrdiff_t>(i));
    predicts = !predicts;
  }
  const auto begin = steps.begin();
  task.head.assign(begin, begin + begins.at(1));
  task.body.assign(begin + begins.at(1), begin + begins.at(2));
  task.tail.assign(begin + begins.at(2), steps.end());
  task.num_bodies = num_blocks - (kBlocksRead - 1);
  return task;
}

void CheckTraceIsOff() {
  if (macrotask::TraceClasses() != 0) {
    throw std::invalid_argument(
        "MACROTASK_TRACE is set: expected no history trace of a program that "
        "records its own");
  }
}

}  // namespace

std::vector<Step> NameBlocks(const std::vector<Step>& steps, bool first_task) {
  std::vector<Step> named;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    Step step = steps[i];
    if (IsCompute(step, Block::kOther)) {
      if (i + 1 == steps.size()) continue;
      if (i == 0 && first_task) {
        step.block = Block::kStart;
      } else if (IsCompute(steps[i + 1], Block::kOcd)) {
        step.block = Block::kCs;
      } else if (steps[i + 1].kind == StepKind::kPost) {
        step.block = Block::kShift;
      } else {
        continue;
      }
    }
    named.push_back(step);
  }
  return named;
}

void PrepareTrace(int most_tasks) {
  CheckTraceIsOff();
  // What a task leaves in the blocks that are read, and in a calibration.
  constexpr std::size_t kRecordsPerTask = 64;
  constexpr std::size_t kLeastRecords = 4096;
  macrotask::SetTraceSize(std::max(
      kLeastRecords, kRecordsPerTask * static_cast<std::size_t>(most_tasks)));
}

Program ReadFigure(const FigureCase& figure_case) {
  CheckTraceIsOff();
  const integrators::BlockMethod& method = figure_case.method;
  integrators::CheckNumSteps(method, figure_case.num_steps);
  const int num_blocks =
      (figure_case.num_steps - (method.num_values - 1)) / method.block_size;
  Program program;
  auto tasks =
      ReadSteps(figure_case, std::min(num_blocks, kBlocksRead), &program);
  for (std::size_t t = 0; t < tasks.size(); ++t) {
    for (Step& step : tasks[t]) step.seconds = 0;
    program.tasks.push_back(Fold(NameBlocks(tasks[t], t == 0), num_blocks));
  }
  return program;
}

}  // namespace bench::predict
