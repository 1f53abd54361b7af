#include "integrators/start.h"

#include <algorithm>
#include <array>
#include <span>
#include <utility>

#include "integrators/combine.h"
#include "integrators/integration_error.h"

namespace integrators {
namespace {

// Dormand & Prince 1980, RK5(4)7M: nodes and rows of A; the last row is also
// the fifth-order solution, so that its derivative is the next step's first.
constexpr int kStages = 7;
constexpr std::array<double, kStages> kNodes = {0,      1. / 5, 3. / 10, 4. / 5,
                                                8. / 9, 1,      1};
constexpr std::array<std::array<double, kStages - 1>, kStages> kRows = {{
    {},
    {1. / 5},
    {3. / 40, 9. / 40},
    {44. / 45, -56. / 15, 32. / 9},
    {19372. / 6561, -25360. / 2187, 64448. / 6561, -212. / 729},
    {9017. / 3168, -355. / 33, 46732. / 5247, 49. / 176, -5103. / 18656},
    {35. / 384, 0, 500. / 1113, 125. / 192, -2187. / 6784, 11. / 84},
}};

}  // namespace

Start::Start(const System& system)
    : system_(system),
      layout_(system),
      factory_(system.MakeFactory(1)),
      evaluation_(factory_->Make(0, system.num_chains(), 0, 1)),
      chain_states_(static_cast<std::size_t>(system.num_chains())),
      chain_rates_(chain_states_.size()),
      coupling_(static_cast<std::size_t>(system.coupling_size())),
      y_(layout_.size()),
      stage_y_(layout_.size()) {
  for (int s = 0; s < kStages; ++s) stage_f_.emplace_back(layout_.size());
}

void Start::Evaluate(double t, const double* y, double* f) {
  for (int k = 0; k < layout_.num_chains(); ++k) {
    const auto at = static_cast<std::size_t>(k);
    chain_states_[at] = y + layout_.chain_offset(k);
    chain_rates_[at] = f + layout_.chain_offset(k);
  }
  const double* common_state = y + layout_.common_offset();
  double* common_rate = f + layout_.common_offset();
  int code = 0;
  evaluation_->Ocd(0, std::span<const double>(&t, 1), chain_states_);
  evaluation_->Rma(0, std::span<const double* const>(&common_state, 1),
                   std::span<double* const>(&common_rate, 1), coupling_.data(),
                   std::span<int>(&code, 1));
  if (const auto error = evaluation_->TakeError()) {
    std::rethrow_exception(error);
  }
  if (code != 0) throw IntegrationError(system_.DescribeFailure(code), t);
  evaluation_->Ccd(coupling_.data(), chain_rates_);
}

// From stage_f_[0] = f(t, y_): y_ and stage_f_.back() at t + h.
void Start::Step(double t, double h) {
  std::array<const double*, kStages> f;
  for (std::size_t s = 0; s < kStages; ++s) f[s] = stage_f_[s].data();
  for (std::size_t s = 1; s < kStages; ++s) {
    std::array<double, kStages - 1> weights;
    for (std::size_t j = 0; j < s; ++j) weights[j] = h * kRows[s][j];
    Combine(y_.size(), y_.data(), std::span(weights).first(s), f.data(),
            stage_y_.data());
    Evaluate(t + kNodes[s] * h, stage_y_.data(), stage_f_[s].data());
  }
  std::copy_n(stage_y_.data(), y_.size(), y_.data());
}

int Start::Dopri5(const double* y0, BlockRun* run) {
  const int steps = run->num_start_steps;
  std::copy_n(y0, layout_.size(), y_.data());
  Evaluate(0, y_.data(), stage_f_[0].data());
  Keep(0, *run);
  Record(0, run);
  for (int n = 0; n < steps; ++n) {
    Step(run->TimeOfGrid(n), run->step);
    std::swap(stage_f_.front(), stage_f_.back());
    Keep(n + 1, *run);
    Record(n + 1, run);
  }
  run->SetStart(y_.data(), history_);
  return 1 + (kStages - 1) * steps;
}

int Start::Exact(const ExactValues& values, BlockRun* run) {
  for (int n = 0; n <= run->num_start_steps; ++n) {
    values(n, y_.data(), stage_f_[0].data());
    Keep(n, *run);
    Record(n, run);
  }
  run->SetStart(y_.data(), history_);
  return 0;
}

// Keeps the derivative at grid point n if the block method will read it.
void Start::Keep(int n, const BlockRun& run) {
  const int k = run.method.num_values;
  while (static_cast<int>(history_.size()) < k) {
    history_.emplace_back(layout_.size());
  }
  const int place = n - run.num_start_steps + k - 1;
  if (place < 0) return;
  std::copy_n(stage_f_[0].data(), y_.size(),
              history_[static_cast<std::size_t>(place)].data());
}

void Start::Record(int n, BlockRun* run) const {
  if (run->trajectory == nullptr) return;
  std::copy_n(y_.data(), layout_.size(),
              run->trajectory + static_cast<std::size_t>(n) * layout_.size());
}

}  // namespace integrators
