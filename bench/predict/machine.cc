#include "bench/predict/machine.h"

#include <fmt/format.h>

#include <bit>
#include <cstddef>
#include <stdexcept>

#include "macrotask/barrier_algorithm.h"

namespace bench::predict {
namespace {

// Levels of macrotask's tree below the root: every parent has four children.
int TreeLevels(int num_tasks) {
  int levels = 0;
  for (int members = 1, row = 1; members < num_tasks; ++levels) {
    row *= 4;
    members += row;
  }
  return levels;
}

}  // namespace

double MeanOf(const Spread& spread) {
  if (spread.size() < 2) return spread.empty() ? 1 : spread[0];
  double sum = (spread.front() + spread.back()) / 2;
  for (std::size_t i = 1; i + 1 < spread.size(); ++i) sum += spread[i];
  return sum / static_cast<double>(spread.size() - 1);
}

double BarrierCost::Seconds(int num_tasks) const {
  if (num_tasks < 2) return 0;
  using macrotask::BarrierAlgorithm;
  const BarrierAlgorithm algorithm =
      macrotask::ChooseBarrierAlgorithm(num_tasks);
  if (algorithm == BarrierAlgorithm::kDissemination && round) {
    return *round * std::bit_width(static_cast<unsigned>(num_tasks - 1));
  }
  if (algorithm == BarrierAlgorithm::kTree && level) {
    return *level * TreeLevels(num_tasks);
  }
  return two + further * (num_tasks - 2);
}

double MachineModel::SlowdownOn(int num_processors, int num_lanes) const {
  double factor = 1;
  for (const Slowdown& slowdown : slowdowns) {
    const bool of_width = slowdown.lanes == 0 || slowdown.lanes == num_lanes;
    if (of_width && num_processors >= slowdown.from_processors) {
      factor = slowdown.factor;
    }
  }
  return factor;
}

const BlockCosts& MachineModel::BlocksOf(int num_lanes) const {
  const auto costs = lanes.find(num_lanes);
  if (costs != lanes.end()) return costs->second;
  std::string known;
  for (const auto& [width, unused] : lanes) {
    known += fmt::format("{}{}", known.empty() ? "" : ", ", width);
  }
  throw std::invalid_argument(
      fmt::format("machine '{}' has no costs for {} lanes: expected one of {}",
                  name, num_lanes, known));
}

const WaitCost& MachineModel::WaitOf(const Condition& condition,
                                     macrotask::WaitKind kind) const {
  const auto costs = condition.waits.find(kind);
  if (costs != condition.waits.end()) return costs->second;
  std::string known;
  for (const auto& [other, unused] : condition.waits) {
    known += (known.empty() ? "" : ", ") + std::string(macrotask::Name(other));
  }
  throw std::invalid_argument(fmt::format(
      "machine '{}' has no costs for the way to wait '{}': expected one of {}",
      name, macrotask::Name(kind), known));
}

}  // namespace bench::predict
