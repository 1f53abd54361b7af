#include "bench/lift_case.h"

#include <algorithm>
#include <utility>

namespace bench {

LiftCase::LiftCase(dynamics::Lift lift, int num_steps)
    : lift_(std::move(lift)),
      plan_(dynamics::MakePlan(lift_.model, lift_.motion,
                               lift_.duration / num_steps, num_steps,
                               lift_.q_guess)),
      torques_(plan_.step, plan_.tau) {}

void LiftCase::CopyColumn(int n, double* y, double* f) const {
  const auto copy = [n](const Eigen::MatrixXd& from, double* to) {
    std::copy_n(from.col(n).data(), from.rows(), to);
    return to + from.rows();
  };
  for (std::size_t k = 0; k < plan_.states.size(); ++k) {
    y = copy(plan_.states[k], y);
    f = copy(plan_.rates[k], f);
  }
  copy(plan_.member, y);
  copy(plan_.member_rate, f);
}

std::vector<double> LiftCase::InitialState() const {
  std::size_t size = dynamics::kMemberStateSize;
  for (const auto& states : plan_.states) {
    size += static_cast<std::size_t>(states.rows());
  }
  std::vector<double> y(size), f(size);
  CopyColumn(0, y.data(), f.data());
  return y;
}

integrators::ExactValues LiftCase::Planned() const {
  return [this](int n, double* y, double* f) { CopyColumn(n, y, f); };
}

dynamics::MemberState<double> LiftCase::Member(
    const std::vector<double>& state) const {
  return dynamics::UnpackMember(state.data() + state.size() -
                                dynamics::kMemberStateSize);
}

double LiftCase::Error(const std::vector<double>& state) const {
  return (Member(state).p - lift_.end).norm();
}

}  // namespace bench
