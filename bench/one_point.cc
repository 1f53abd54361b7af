#include "bench/one_point.h"

namespace bench {

OnePoint::OnePoint(const LiftCase& lift, dynamics::Lanes lanes)
    : system_(lift.lift().model, lift.torques(), lanes),
      exchange_(system_.MakeExchange(1)),
      evaluator_(
          system_.MakeEvaluator(0, system_.num_chains(), 0, 1, &exchange_)),
      state_(lift.InitialState()),
      rate_(state_.size()) {
  const int n = lift.num_steps() / 2;
  lift.Planned()(n, state_.data(), rate_.data());
  time_ = n * lift.step();
  std::size_t offset = 0;
  for (int k = 0; k < system_.num_chains(); ++k) {
    chain_states_.push_back(state_.data() + offset);
    chain_rates_.push_back(rate_.data() + offset);
    offset += static_cast<std::size_t>(system_.chain_size(k));
  }
  common_state_ = state_.data() + offset;
  common_rate_ = rate_.data() + offset;
}

void OnePoint::Ocd() { evaluator_.Ocd(0, {&time_, 1}, chain_states_); }

void OnePoint::Rma() {
  evaluator_.Rma(0, {&common_state_, 1}, {&common_rate_, 1}, a_r_,
                 {&failure_, 1});
}

void OnePoint::Ccd() { evaluator_.Ccd(a_r_, chain_rates_); }

}  // namespace bench
