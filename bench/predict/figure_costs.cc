#include "bench/predict/figure_costs.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace bench::predict {
namespace {

using integrators::Figure;
using integrators::Partition;

constexpr int kDoublesPerLine = 8;

double CeilDiv(int a, int b) { return static_cast<double>((a + b - 1) / b); }

// Tasks are placed neighbours together, as many or one more on a processor.
int ProcessorOf(int task, int num_tasks, int num_processors) {
  const long used = std::min(num_tasks, num_processors);
  return static_cast<int>(task * used / num_tasks);
}

class Counter {
 public:
  Counter(const FigureCase& figure_case, const SystemSizes& sizes,
          int num_lanes, int task, int num_processors)
      : case_(figure_case),
        sizes_(sizes),
        num_lanes_(num_lanes),
        i_(task / figure_case.partition.chain_tasks),
        k_(task % figure_case.partition.chain_tasks),
        num_processors_(num_processors),
        share_(ShareOf(figure_case, i_, k_)) {}

  Counts Of(Block block) const {
    const int pairs = share_.chains * share_.points;
    const int k = case_.method.num_values;
    switch (block) {
      case Block::kStart:
        return {0, static_cast<double>(k * ColumnSize(case_.num_chains)), 0};
      case Block::kCs:
        return {
            static_cast<double>(share_.points),
            static_cast<double>(share_.points * k * ColumnSize(share_.chains)),
            LinesOfPoints()};
      case Block::kOcd:
      case Block::kCcd:
        return {CeilDiv(pairs, num_lanes_), static_cast<double>(pairs), 0};
      case Block::kRma:
        return {CeilDiv(share_.points, num_lanes_),
                static_cast<double>(share_.points * case_.num_chains),
                LinesOfTips()};
      case Block::kShift:
      case Block::kOther:
        break;
    }
    return {};
  }

 private:
  int ColumnSize(int chains) const {
    return chains * sizes_.chain + sizes_.common;
  }

  bool IsElsewhere(int i, int k) const {
    const Partition& partition = case_.partition;
    const auto processor = [&](int a, int b) {
      return ProcessorOf(a * partition.chain_tasks + b, partition.num_tasks(),
                         num_processors_);
    };
    return processor(i, k) != processor(i_, k_);
  }

  // Derivatives of the column at points of tasks elsewhere.
  double LinesOfPoints() const {
    int points = 0;
    for (int i = 0; i < case_.partition.integration_tasks; ++i) {
      if (IsElsewhere(i, k_)) points += ShareOf(case_, i, k_).points;
    }
    return points * CeilDiv(ColumnSize(share_.chains), kDoublesPerLine);
  }

  // Tips of chains of tasks elsewhere, at the own points.
  double LinesOfTips() const {
    int chains = 0;
    for (int k = 0; k < case_.partition.chain_tasks; ++k) {
      if (IsElsewhere(i_, k)) chains += ShareOf(case_, i_, k).chains;
    }
    return share_.points * chains * sizes_.tip_lines;
  }

  const FigureCase& case_;
  const SystemSizes& sizes_;
  const int num_lanes_;
  const int i_, k_;
  const int num_processors_;
  const TaskShare share_;
};

}  // namespace

TaskShare ShareOf(const FigureCase& figure_case, int i, int k) {
  const Partition& partition = figure_case.partition;
  return {integrators::ShareOf(figure_case.num_chains, partition.chain_tasks, k)
              .count,
          integrators::ShareOf(figure_case.method.block_size,
                               partition.integration_tasks, i)
              .count};
}

Counts CountsOf(Block block, const FigureCase& figure_case,
                const SystemSizes& sizes, int num_lanes, int task,
                int num_processors) {
  return Counter(figure_case, sizes, num_lanes, task, num_processors).Of(block);
}

void SetCosts(const FigureCase& figure_case, const SystemSizes& sizes,
              const BlockCosts& blocks, const RunCosts& costs,
              Program* program) {
  for (int t = 0; t < program->num_tasks(); ++t) {
    const Counter counter(figure_case, sizes, costs.num_lanes, t,
                          costs.num_processors);
    std::array<double, kNumBlocks> seconds{};
    const double busy = costs.work * counter.Of(Block::kOcd).items;
    for (int b = 0; b < kNumBlocks; ++b) {
      const auto block = static_cast<Block>(b);
      const Counts counts = counter.Of(block);
      const double line =
          block == Block::kRma ? costs.tip_line : costs.point_line;
      seconds[static_cast<std::size_t>(b)] =
          costs.slowdown * blocks[static_cast<std::size_t>(b)].Seconds(
                               counts.packs, counts.items) +
          counts.lines * line;
    }
    TaskProgram& task = program->tasks[static_cast<std::size_t>(t)];
    for (std::vector<Step>* part : {&task.head, &task.body, &task.tail}) {
      for (Step& step : *part) {
        if (step.kind != StepKind::kCompute) continue;
        step.seconds = seconds[static_cast<std::size_t>(step.block)];
        if (step.block == Block::kOcd) step.busy = busy;
      }
    }
  }
}

}  // namespace bench::predict
