#include "integrators/block_task.h"

#include "integrators/combine.h"

namespace integrators {
namespace {

std::size_t SetOf(Phase phase) { return static_cast<std::size_t>(phase); }

std::vector<double> Scaled(const std::vector<Rational>& weights, double h) {
  std::vector<double> scaled;
  for (const Rational& weight : weights) scaled.push_back(h * weight.value());
  return scaled;
}

// Writes to every line of `values`, so that the processor asks for them as its
// own. CCD will fill them a microsecond later; its first store to a line that
// others have read would wait for it, one line after the other.
void ClaimLines(double* values, std::size_t size) {
  for (std::size_t e = 0; e < size; e += AlignedDoubles::kDoublesPerLine) {
    values[e] = 0;
  }
}

Share PointsOf(const BlockRun& run, int i) {
  return ShareOf(run.method.block_size, run.partition.integration_tasks, i);
}

}  // namespace

BlockTask::BlockTask(BlockRun* run, int i, int k, EvaluationFactory* factory)
    : run_(*run),
      column_(run->columns[static_cast<std::size_t>(k)]),
      failure_(run->failure(i, k)),
      rma_column_(run->rma == RmaSharing::kSerial ? 0 : k),
      first_point_(PointsOf(*run, i).first + 1),
      times_(static_cast<std::size_t>(PointsOf(*run, i).count)),
      codes_(times_.size()),
      evaluation_(factory->Make(column_.layout().first_chain(),
                                column_.layout().num_chains(), first_point_ - 1,
                                num_points())),
      own_coupling_(
          static_cast<std::size_t>(num_points() * run->system.coupling_size())),
      coupling_(own_coupling_.data()) {
  if (run_.rma == RmaSharing::kSerial) {
    coupling_ = run_.shared_coupling.data() +
                (first_point_ - 1) * run_.system.coupling_size();
  }
  for (int local = 0; local < num_points(); ++local) {
    const auto row = static_cast<std::size_t>(point(local) - 1);
    predictor_weights_.push_back(Scaled(run_.method.predictor[row], run_.step));
    corrector_weights_.push_back(Scaled(run_.method.corrector[row], run_.step));
  }
  for (int place = 0; place < column_.num_places(); ++place) {
    places_.push_back(MakePlace(place));
  }
}

BlockTask::Place BlockTask::MakePlace(int at) {
  const BlockMethod& method = run_.method;
  const StateLayout& layout = column_.layout();
  Place place;
  place.y0 = column_.y(at, 0).data();
  for (int offset = 1 - method.num_values; offset <= 0; ++offset) {
    place.predictor_f.push_back(column_.f(at, offset).data());
  }
  for (int offset = method.first_corrector_offset();
       offset <= method.block_size; ++offset) {
    place.corrector_f.push_back(offset <= 0
                                    ? column_.f(at, offset).data()
                                    : column_.f_predicted(offset).data());
  }
  for (int local = 0; local < num_points(); ++local) {
    const int i = point(local);
    double* y = column_.y(at, i).data();
    double* rates[2] = {column_.f_predicted(i).data(), column_.f(at, i).data()};
    place.y.push_back(y);
    for (int set : {0, 1}) place.f[set].push_back(rates[set]);
    for (int c = 0; c < layout.num_chains(); ++c) {
      const std::size_t offset = layout.chain_offset(c);
      place.chain_states.push_back(y + offset);
      for (int set : {0, 1}) {
        place.chain_rates[set].push_back(rates[set] + offset);
      }
    }
    place.common_states.push_back(y + layout.common_offset());
    for (int set : {0, 1}) {
      place.common_rates[set].push_back(rates[set] + layout.common_offset());
    }
  }
  return place;
}

// All owned points: y_i = y_0 + sum_j weights[i][j] f[j].
void BlockTask::Combine(const std::vector<std::vector<double>>& weights,
                        const std::vector<const double*>& f) {
  const std::size_t size = column_.y(0, 0).size();
  for (std::size_t local = 0; local < weights.size(); ++local) {
    integrators::Combine(size, place_->y0, weights[local], f.data(),
                         place_->y[local]);
  }
}

void BlockTask::Predict() {
  place_ = &places_[static_cast<std::size_t>(column_.place())];
  for (int local = 0; local < num_points(); ++local) {
    times_[static_cast<std::size_t>(local)] =
        run_.TimeOfGrid(column_.newest() + point(local));
  }
  Combine(predictor_weights_, place_->predictor_f);
}

void BlockTask::Correct() {
  Combine(corrector_weights_, place_->corrector_f);
  if (run_.trajectory == nullptr) return;
  for (int local = 0; local < num_points(); ++local) {
    const int n = column_.newest() + point(local);
    run_.CopyToFull(
        column_, place_->y[static_cast<std::size_t>(local)],
        run_.trajectory + static_cast<std::size_t>(n) * run_.layout.size());
  }
}

void BlockTask::Ocd(Phase phase) {
  const std::size_t size = column_.y(0, 0).size();
  for (double* f : place_->f[SetOf(phase)]) ClaimLines(f, size);
  evaluation_->Ocd(static_cast<int>(phase), times_, place_->chain_states);
}

void BlockTask::Rma(Phase phase) {
  evaluation_->Rma(static_cast<int>(phase), place_->common_states,
                   place_->common_rates[SetOf(phase)], coupling_, codes_);
  for (std::size_t at = 0; at < codes_.size(); ++at) {
    if (codes_[at] == 0 || failure_.code != 0) continue;
    failure_ = {.code = codes_[at], .phase = phase, .time = times_[at]};
  }
}

void BlockTask::Ccd(Phase phase) {
  evaluation_->Ccd(coupling_, place_->chain_rates[SetOf(phase)]);
}

void BlockTask::ShiftBlocks() {
  for (int i = 0; i < run_.partition.integration_tasks; ++i) {
    if (run_.failure(i, rma_column_).code != 0) return column_.End();
  }
  column_.ShiftBlocks();
}

}  // namespace integrators
