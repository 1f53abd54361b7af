#include "bench/predict/program.h"

#include <numeric>

namespace bench::predict {

std::string_view Name(Block block) {
  constexpr std::array<std::string_view, kNumBlocks> kNames = {
      "start", "CS", "OCD", "RMA", "CCD", "shift", "other"};
  return kNames[static_cast<std::size_t>(block)];
}

std::array<double, kNumBlocks> WorkByBlock(const Program& program) {
  std::array<double, kNumBlocks> seconds{};
  for (const TaskProgram& task : program.tasks) {
    const auto add = [&](const std::vector<Step>& steps, double times) {
      for (const Step& step : steps) {
        if (step.kind != StepKind::kCompute) continue;
        seconds[static_cast<std::size_t>(step.block)] +=
            times * (step.seconds + step.busy);
      }
    };
    add(task.head, 1);
    add(task.body, static_cast<double>(task.num_bodies));
    add(task.tail, 1);
  }
  return seconds;
}

double Work(const Program& program) {
  const auto blocks = WorkByBlock(program);
  return std::accumulate(blocks.begin(), blocks.end(), 0.0);
}

}  // namespace bench::predict
