#include "integrators/block_task.h"

#include <algorithm>

#include "integrators/combine.h"

namespace integrators {
namespace {

int SetOf(Phase phase) { return static_cast<int>(phase); }

std::vector<double> Scaled(const std::vector<Rational>& weights, double h) {
  std::vector<double> scaled;
  for (const Rational& weight : weights) scaled.push_back(h * weight.value());
  return scaled;
}

}  // namespace

BlockTask::BlockTask(BlockRun* run, int i, int k, EvaluationFactory* factory)
    : run_(*run),
      column_(run->columns[static_cast<std::size_t>(k)]),
      failure_(run->failure(i, k)),
      rma_column_(run->rma == RmaSharing::kSerial ? 0 : k),
      first_point_(1 + run->method.block_size * i /
                           run->partition.integration_tasks),
      num_points_(1 +
                  run->method.block_size * (i + 1) /
                      run->partition.integration_tasks -
                  first_point_),
      evaluation_(factory->Make(column_.layout().first_chain(),
                                column_.layout().num_chains(), first_point_ - 1,
                                num_points_)),
      own_coupling_(
          static_cast<std::size_t>(num_points_ * run->system.coupling_size())),
      coupling_(own_coupling_.data()),
      times_(static_cast<std::size_t>(num_points_)),
      codes_(static_cast<std::size_t>(num_points_)) {
  const BlockMethod& method = run_.method;
  if (run_.rma == RmaSharing::kSerial) {
    coupling_ = run_.shared_coupling.data() +
                (first_point_ - 1) * run_.system.coupling_size();
  }
  for (int j = 1 - method.num_values; j <= 0; ++j) {
    predictor_f_.push_back(column_.f(j).data());
  }
  for (int j = method.first_corrector_offset(); j <= method.block_size; ++j) {
    corrector_f_.push_back(j <= 0 ? column_.f(j).data()
                                  : column_.point(j).f_predicted.data());
  }
  for (int local = 0; local < num_points_; ++local) BindPoint(point(local));
}

void BlockTask::BindPoint(int i) {
  const auto row = static_cast<std::size_t>(i - 1);
  predictor_weights_.push_back(Scaled(run_.method.predictor[row], run_.step));
  corrector_weights_.push_back(Scaled(run_.method.corrector[row], run_.step));

  PointSlots& slots = column_.point(i);
  const StateLayout& layout = column_.layout();
  double* rates[2] = {slots.f_predicted.data(), slots.f_corrected.data()};
  for (int c = 0; c < layout.num_chains(); ++c) {
    const std::size_t offset = layout.chain_offset(c);
    chain_states_.push_back(slots.y.data() + offset);
    for (int set : {0, 1}) chain_rates_[set].push_back(rates[set] + offset);
  }
  const std::size_t offset = layout.common_offset();
  common_states_.push_back(slots.y.data() + offset);
  for (int set : {0, 1}) common_rates_[set].push_back(rates[set] + offset);
}

void BlockTask::Predict(int block) {
  block_ = block;
  for (int local = 0; local < num_points_; ++local) {
    const auto at = static_cast<std::size_t>(local);
    times_[at] = run_.TimeOfGrid(run_.GridOf(block, point(local)));
    AlignedDoubles& y = column_.point(point(local)).y;
    Combine(y.size(), column_.y0().data(), predictor_weights_[at],
            predictor_f_.data(), y.data());
  }
}

void BlockTask::Correct() {
  for (int local = 0; local < num_points_; ++local) {
    const auto at = static_cast<std::size_t>(local);
    AlignedDoubles& y = column_.point(point(local)).y;
    Combine(y.size(), column_.y0().data(), corrector_weights_[at],
            corrector_f_.data(), y.data());
    if (run_.trajectory != nullptr) {
      const auto row =
          static_cast<std::size_t>(run_.GridOf(block_, point(local)));
      run_.CopyToFull(column_, y.data(),
                      run_.trajectory + row * run_.layout.size());
    }
  }
}

void BlockTask::Ocd(Phase phase) {
  evaluation_->Ocd(SetOf(phase), times_, chain_states_);
}

void BlockTask::Rma(Phase phase) {
  evaluation_->Rma(SetOf(phase), common_states_, common_rates_[SetOf(phase)],
                   coupling_, codes_);
  for (std::size_t at = 0; at < codes_.size(); ++at) {
    if (codes_[at] == 0 || failure_.code != 0) continue;
    failure_ = {.code = codes_[at], .time = times_[at]};
  }
}

void BlockTask::Ccd(Phase phase) {
  evaluation_->Ccd(coupling_, chain_rates_[SetOf(phase)]);
}

bool BlockTask::Failed() const {
  for (int i = 0; i < run_.partition.integration_tasks; ++i) {
    if (run_.failure(i, rma_column_).code != 0) return true;
  }
  return false;
}

}  // namespace integrators
