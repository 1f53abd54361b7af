#include "integrators/block_run.h"

#include <algorithm>
#include <tuple>
#include <utility>

namespace integrators {
BlockRun::BlockRun(const System& run_system, BlockMethod run_method,
                   double run_step, int run_num_steps, Partition run_partition,
                   RmaSharing run_rma)
    : system(run_system),
      method(std::move(run_method)),
      step(run_step),
      num_steps(run_num_steps),
      partition(run_partition),
      rma(run_rma),
      num_start_steps(NumStartSteps(method, num_steps)),
      num_blocks((num_steps - num_start_steps) / method.block_size),
      layout(system),
      failures(static_cast<std::size_t>(partition.num_tasks())),
      shared_coupling(static_cast<std::size_t>(method.block_size *
                                               system.coupling_size())) {
  for (int part = 0; part < partition.chain_tasks; ++part) {
    const Share chains =
        ShareOf(system.num_chains(), partition.chain_tasks, part);
    const bool has_common = rma == RmaSharing::kRedundant || part == 0;
    columns.emplace_back(
        method, StateLayout(system, chains.first, chains.count, has_common),
        num_start_steps);
  }
}

int BlockRun::NumStartSteps(const BlockMethod& method, int num_steps) {
  const int k = method.num_values;
  return k - 1 + std::max(0, num_steps - (k - 1)) % method.block_size;
}

void BlockRun::SetStart(const double* y0,
                        const std::vector<AlignedDoubles>& f) {
  for (Column& column : columns) {
    const StateLayout& part = column.layout();
    const auto take = [&](const double* full, AlignedDoubles* target) {
      const double* chains = full + layout.chain_offset(part.first_chain());
      std::copy_n(chains, part.common_offset(), target->data());
      std::copy_n(full + layout.common_offset(), part.common_size(),
                  target->data() + part.common_offset());
    };
    column.Rewind();
    take(y0, &column.y(0, 0));
    for (int offset = 1 - method.num_values; offset <= 0; ++offset) {
      const int j = offset + method.num_values - 1;
      take(f[static_cast<std::size_t>(j)].data(), &column.f(0, offset));
    }
  }
  for (auto& failure : failures) *failure = Failure();
}

void BlockRun::CopyToFull(const Column& column, const double* part,
                          double* full) const {
  const StateLayout& of = column.layout();
  std::copy_n(part, of.common_offset(),
              full + layout.chain_offset(of.first_chain()));
  if (of.first_chain() == 0) {
    std::copy_n(part + of.common_offset(), of.common_size(),
                full + layout.common_offset());
  }
}

Failure BlockRun::FirstFailure() const {
  const auto order = [](const Failure& failure) {
    return std::tuple(failure.phase, failure.time, failure.code);
  };
  Failure first;
  for (const auto& failure : failures) {
    if (failure->code == 0) continue;
    if (first.code == 0 || order(*failure) < order(first)) first = *failure;
  }
  return first;
}

}  // namespace integrators
