#pragma once

#include <Eigen/Core>
#include <exception>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "dynamics/reference_member.h"

namespace dynamics {

class ClosedChainSystem;

// The state of the whole system, as an integrator sees it, is one vector a
// chain and one for the reference member:
//
//   chain k  [q (N_k); q' (N_k)]
//   member   [Q (4: w x y z); p (3); omega (3); v (3)]
//
inline constexpr int kMemberStateSize = 13;

MemberState<double> UnpackMember(const double* y);
void PackMember(const MemberState<double>& state, double* y);

// What the chains write and RMA reads: two sets of one slot a (point, chain),
// each on cache lines of its own. The sets serve alternate evaluations, because
// a task may begin the next while another still reads this one's.
class TipExchange {
 public:
  struct alignas(64) Slot {
    TipInertia<double> tip;
    double margin;  // see OpenChain
  };

  // Lambda begins the slot, and margin is in its last line (see ClaimSlots).
  static_assert(sizeof(Slot) == 4 * 64);

  TipExchange(int num_points, int num_chains)
      : num_points_(num_points),
        num_chains_(num_chains),
        slots_(2 * static_cast<std::size_t>(num_points * num_chains)) {}

  int num_chains() const { return num_chains_; }
  Slot& slot(int set, int point, int k) {
    return slots_[static_cast<std::size_t>(
        (set * num_points_ + point) * num_chains_ + k)];
  }

 private:
  int num_points_;
  int num_chains_;
  std::vector<Slot> slots_;
};

// One task's share of the derivative computation (Figure 1). Between Ocd and
// Rma all tasks that evaluate the same points must synchronize. None of the
// calls allocates. Pairs of (chain, point) are numbered point by point: pair =
// point * num_chains + chain, both counted from the task's first.
class Evaluator {
 public:
  // What computes a share; one for each scalar type.
  class Impl {
   public:
    virtual ~Impl() = default;
    virtual void Ocd(int set, std::span<const double> times,
                     std::span<const double* const> chain_states) = 0;
    virtual void Rma(int set, std::span<const double* const> common_states,
                     std::span<double* const> common_derivatives, double* a_r,
                     std::span<int> failures) = 0;
    virtual void Ccd(const double* a_r,
                     std::span<double* const> chain_derivatives) = 0;
    virtual Vector6<double> TipForce(int pair) const = 0;
    virtual Eigen::VectorXd Torques(int pair) const = 0;
    virtual std::exception_ptr TakeError() = 0;
  };
  explicit Evaluator(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}

  // OCD of all pairs: `times` (s) by point, `chain_states` by pair. Leaves the
  // result in set 0 or 1 of the exchange.
  void Ocd(int set, std::span<const double> times,
           std::span<const double* const> chain_states) {
    impl_->Ocd(set, times, chain_states);
  }

  // RMA at all points: reads every chain's slots, in order of the chains, and
  // `common_states` by point; fills `a_r` (6 a point) and the derivatives of
  // the common states. `failures` receives a code a point: 0; k + 1 if chain k
  // is the first singular one; -(k + 1) if chain k is the first whose x''_open
  // is not finite; -(m + 1) if only a_r is not.
  void Rma(int set, std::span<const double* const> common_states,
           std::span<double* const> common_derivatives, double* a_r,
           std::span<int> failures) {
    impl_->Rma(set, common_states, common_derivatives, a_r, failures);
  }

  // CCD of all pairs with the accelerations `a_r` (6 a point): the chains'
  // derivatives [q'; q''].
  void Ccd(const double* a_r, std::span<double* const> chain_derivatives) {
    impl_->Ccd(a_r, chain_derivatives);
  }

  // f_k of the last Ccd: [moment; force] about P, world axes, exerted on the
  // reference member.
  Vector6<double> TipForce(int pair) const { return impl_->TipForce(pair); }
  // The torques that the last Ocd used.
  Eigen::VectorXd Torques(int pair) const { return impl_->Torques(pair); }

  // What the torque source threw since the last call, if it did: its torques
  // count as NaN.
  std::exception_ptr TakeError() { return impl_->TakeError(); }

 private:
  std::unique_ptr<Impl> impl_;
};

// The evaluator of a share with the scalar type that `system` computes with;
// see ClosedChainSystem::MakeEvaluator.
Evaluator MakeEvaluatorOf(const ClosedChainSystem& system, int first_chain,
                          int num_chains, int first_point, int num_points,
                          TipExchange* exchange);

}  // namespace dynamics
