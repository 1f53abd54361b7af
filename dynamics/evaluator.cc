#include "dynamics/evaluator.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "dynamics/closed_chain.h"
#include "dynamics/closed_chain_system.h"
#include "dynamics/open_chain.h"

namespace dynamics {
namespace {

// (chain, point) pairs that share a pack, and all that is computed for them.
template <typename S>
struct PairGroup {
  struct Pair {
    int index;  // within the task
    int k;      // chain, within the system
    int point;  // within the task
  };

  PairGroup(const SystemModel& model, const std::vector<Pair>& members)
      : pairs(members),
        num_joints(model.chains[members[0].k].arm.num_joints()),
        q(num_joints),
        qd(num_joints),
        tau(num_joints),
        qdd(num_joints),
        lane_tau(num_joints),
        work(num_joints),
        open(num_joints) {
    std::vector<const Chain*> chains;
    for (const Pair& pair : pairs) chains.push_back(&model.chains[pair.k]);
    constants = MakeChainConstants<S>(chains, model.gravity);
  }

  std::vector<Pair> pairs;  // lane l computes pairs[l]; the last one also fills
                            // the lanes that are left over
  int num_joints;
  ChainConstants<S> constants;
  VectorX<S> q, qd, tau, qdd;
  Eigen::VectorXd lane_tau;
  OpenChainWork<S> work;
  OpenChain<S> open;
  Vector6<S> f;
};

// Fills all lanes with what a point has to say, the first one's value where
// there are fewer points than lanes.
template <typename S>
void SetPoint(int lane, double value, S* target) {
  if (lane == 0) {
    *target = S(value);
  } else {
    SetLane(target, lane, value);
  }
}

// The states of `num_points` <= kLanesOf<S> points, a lane each.
template <typename S>
MemberState<S> LoadMember(const double* const* states, int num_points) {
  MemberState<S> member;
  for (int lane = 0; lane < num_points; ++lane) {
    const double* y = states[lane];
    for (S& x : member.Q) SetPoint(lane, *y++, &x);
    for (S& x : member.p) SetPoint(lane, *y++, &x);
    for (S& x : member.omega) SetPoint(lane, *y++, &x);
    for (S& x : member.v) SetPoint(lane, *y++, &x);
  }
  return member;
}

template <typename S>
void StoreMember(const MemberState<S>& member, int lane, double* y) {
  for (const S& x : member.Q) *y++ = Lane(x, lane);
  for (const S& x : member.p) *y++ = Lane(x, lane);
  for (const S& x : member.omega) *y++ = Lane(x, lane);
  for (const S& x : member.v) *y++ = Lane(x, lane);
}

template <typename S>
class EvaluatorImpl final : public Evaluator::Impl {
 public:
  EvaluatorImpl(const ClosedChainSystem& system, int first_chain,
                int num_chains, int first_point, int num_points,
                TipExchange* exchange)
      : system_(system),
        first_point_(first_point),
        num_points_(num_points),
        exchange_(*exchange) {
    MakeGroups(first_chain, num_chains);
  }

  void Ocd(int set, std::span<const double> times,
           std::span<const double* const> chain_states) override {
    for (const PairGroup<S>& group : groups_) ClaimSlots(set, group);
    for (PairGroup<S>& group : groups_) {
      Load(times, chain_states, &group);
      CalcOpenChain(group.constants, group.q.data(), group.qd.data(),
                    group.tau.data(), &group.work, &group.open);
      Publish(set, group);
    }
  }

  void Rma(int set, std::span<const double* const> common_states,
           std::span<double* const> common_derivatives, double* a_r,
           std::span<int> failures) override {
    for (int first = 0; first < num_points_; first += kLanesOf<S>) {
      const int points = std::min(kLanesOf<S>, num_points_ - first);
      SumTips(set, first, points, failures);
      const MemberState<S> member =
          LoadMember<S>(common_states.data() + first, points);
      Vector6<S> a;
      const S margin = CalcMemberAcceleration(
          system_.model().member, system_.model().gravity, member, sum_, &a);
      const MemberState<S> rate = MemberDerivative(member, a);
      for (int lane = 0; lane < points; ++lane) {
        const int point = first + lane;
        for (int i = 0; i < 6; ++i) a_r[6 * point + i] = Lane(a[i], lane);
        StoreMember(rate, lane, common_derivatives[point]);
        const bool sane = Lane(margin, lane) > 0;
        if (failures[point] == 0 && !sane) {
          failures[point] = -1 - FirstNotFinite(set, point);
        }
      }
    }
  }

  void Ccd(const double* a_r,
           std::span<double* const> chain_derivatives) override {
    for (PairGroup<S>& group : groups_) {
      Vector6<S> a;
      for (int lane = 0; lane < kLanesOf<S>; ++lane) {
        const double* a_point = a_r + 6 * PairOfLane(group, lane).point;
        for (int i = 0; i < 6; ++i) SetLane(&a[i], lane, a_point[i]);
      }
      CalcClosedChain(group.open, a, &group.f, group.qdd.data());
      Store(group, chain_derivatives);
    }
  }

  Vector6<double> TipForce(int pair) const override {
    const auto [group, lane] = Find(pair);
    Vector6<double> f;
    for (int i = 0; i < 6; ++i) f[i] = Lane(group->f[i], lane);
    return f;
  }

  Eigen::VectorXd Torques(int pair) const override {
    const auto [group, lane] = Find(pair);
    Eigen::VectorXd tau(group->num_joints);
    for (int i = 0; i < tau.size(); ++i) tau[i] = Lane(group->tau[i], lane);
    return tau;
  }

  std::exception_ptr TakeError() override {
    return std::exchange(error_, nullptr);
  }

 private:
  using Pair = typename PairGroup<S>::Pair;

  // Packs hold pairs whose chains have the same joints, in the order of the
  // pairs. Which pairs meet in a pack depends on the partition; what a lane
  // computes does not.
  void MakeGroups(int first_chain, int num_chains) {
    const SystemModel& model = system_.model();
    std::vector<std::vector<Pair>> kinds;
    for (int point = 0; point < num_points_; ++point) {
      for (int c = 0; c < num_chains; ++c) {
        const Pair pair = {point * num_chains + c, first_chain + c, point};
        const auto same = [&](const std::vector<Pair>& kind) {
          return SameJointTypes(model.chains[kind[0].k].arm,
                                model.chains[pair.k].arm);
        };
        auto kind = std::find_if(kinds.begin(), kinds.end(), same);
        if (kind == kinds.end()) kind = kinds.emplace(kinds.end());
        kind->push_back(pair);
      }
    }
    for (const std::vector<Pair>& kind : kinds) {
      for (std::size_t i = 0; i < kind.size(); i += kLanesOf<S>) {
        const std::size_t end = std::min(i + kLanesOf<S>, kind.size());
        groups_.emplace_back(
            model, std::vector<Pair>(kind.begin() + static_cast<long>(i),
                                     kind.begin() + static_cast<long>(end)));
      }
    }
  }

  // Lanes that are left over repeat the last pair, so that they compute with
  // sane numbers; nobody reads them.
  static const Pair& PairOfLane(const PairGroup<S>& group, int lane) {
    const auto last = group.pairs.size() - 1;
    return group.pairs[std::min(static_cast<std::size_t>(lane), last)];
  }

  void Load(std::span<const double> times,
            std::span<const double* const> chain_states, PairGroup<S>* group) {
    const int n = group->num_joints;
    for (int lane = 0; lane < kLanesOf<S>; ++lane) {
      const Pair& pair = PairOfLane(*group, lane);
      const double* y = chain_states[pair.index];
      if (lane < static_cast<int>(group->pairs.size())) {
        CalcTorques(pair, times[pair.point], y, &group->lane_tau);
      }
      for (int i = 0; i < n; ++i) {
        SetLane(&group->q[i], lane, y[i]);
        SetLane(&group->qd[i], lane, y[n + i]);
        SetLane(&group->tau[i], lane, group->lane_tau[i]);
      }
    }
  }

  // Other tasks are waiting for this one at the next barrier, so an exception
  // must not leave: it becomes NaN, which RMA reports to all.
  void CalcTorques(const Pair& pair, double t, const double* y,
                   Eigen::VectorXd* tau) {
    try {
      system_.torques().Calc(pair.k, t, y, y + tau->size(), tau->data());
    } catch (...) {
      if (!error_) error_ = std::current_exception();
      tau->setConstant(std::numeric_limits<double>::quiet_NaN());
    }
  }

  TipExchange::Slot& SlotOf(int set, const Pair& pair) {
    return exchange_.slot(set, first_point_ + pair.point, pair.k);
  }

  // Writes to every line of the slots that Publish will fill, so that the
  // processor asks for them as its own while it computes. Their readers are
  // other tasks; Publish would wait for one line after the other.
  void ClaimSlots(int set, const PairGroup<S>& group) {
    for (const Pair& pair : group.pairs) {
      TipExchange::Slot& slot = SlotOf(set, pair);
      for (int i = 0; i < kTriangle6; i += 8) slot.tip.Lambda[i] = 0;
      slot.margin = 0;
    }
  }

  void Publish(int set, const PairGroup<S>& group) {
    const OpenChain<S>& open = group.open;
    for (int lane = 0; lane < static_cast<int>(group.pairs.size()); ++lane) {
      TipExchange::Slot& slot = SlotOf(set, group.pairs[lane]);
      int element = 0;
      for (int a = 0; a < 6; ++a) {
        for (int b = 0; b <= a; ++b) {
          slot.tip.Lambda[element++] = Lane(open.Lambda(a, b), lane);
        }
        slot.tip.Lambda_a_open[a] = Lane(open.Lambda_a_open[a], lane);
      }
      slot.margin = Lane(open.margin, lane);
    }
  }

  // sum_ <- sums over the chains at `points` points, a lane each; `failures` <-
  // the first singular chain of each.
  void SumTips(int set, int first, int points, std::span<int> failures) {
    for (int lane = 0; lane < points; ++lane) {
      const int point = first + lane;
      failures[point] = 0;
      TipInertia<double> sum;
      for (int k = 0; k < exchange_.num_chains(); ++k) {
        const TipExchange::Slot& slot =
            exchange_.slot(set, first_point_ + point, k);
        if (k == 0) {
          sum = slot.tip;
        } else {
          sum += slot.tip;
        }
        const bool regular = slot.margin > 0;
        if (failures[point] == 0 && !regular) {
          failures[point] = std::isnan(slot.margin) ? -(k + 1) : k + 1;
        }
      }
      for (int i = 0; i < kTriangle6; ++i) {
        SetPoint(lane, sum.Lambda[i], &sum_.Lambda[i]);
      }
      for (int i = 0; i < 6; ++i) {
        SetPoint(lane, sum.Lambda_a_open[i], &sum_.Lambda_a_open[i]);
      }
    }
  }

  // The first chain whose x''_open is not finite at the point; their number if
  // there is none.
  int FirstNotFinite(int set, int point) {
    int k = 0;
    for (; k < exchange_.num_chains(); ++k) {
      const auto& values =
          exchange_.slot(set, first_point_ + point, k).tip.Lambda_a_open;
      const auto finite = [](double x) { return std::isfinite(x); };
      if (!std::all_of(values.begin(), values.end(), finite)) break;
    }
    return k;
  }

  static void Store(const PairGroup<S>& group,
                    std::span<double* const> chain_derivatives) {
    const int n = group.num_joints;
    for (int lane = 0; lane < static_cast<int>(group.pairs.size()); ++lane) {
      double* rate = chain_derivatives[group.pairs[lane].index];
      for (int i = 0; i < n; ++i) {
        rate[i] = Lane(group.qd[i], lane);
        rate[n + i] = Lane(group.qdd[i], lane);
      }
    }
  }

  std::pair<const PairGroup<S>*, int> Find(int pair) const {
    for (const PairGroup<S>& group : groups_) {
      for (std::size_t lane = 0; lane < group.pairs.size(); ++lane) {
        if (group.pairs[lane].index == pair) {
          return {&group, static_cast<int>(lane)};
        }
      }
    }
    throw std::out_of_range("no such pair of chain and point in this share");
  }

  const ClosedChainSystem& system_;
  int first_point_;
  int num_points_;
  TipExchange& exchange_;
  std::vector<PairGroup<S>> groups_;
  TipInertia<S> sum_;
  std::exception_ptr error_;
};

}  // namespace

MemberState<double> UnpackMember(const double* y) {
  return LoadMember<double>(&y, 1);
}

void PackMember(const MemberState<double>& state, double* y) {
  StoreMember(state, 0, y);
}

Evaluator MakeEvaluatorOf(const ClosedChainSystem& system, int first_chain,
                          int num_chains, int first_point, int num_points,
                          TipExchange* exchange) {
  if (system.lanes() == Lanes::kOne) {
    return Evaluator(std::make_unique<EvaluatorImpl<double>>(
        system, first_chain, num_chains, first_point, num_points, exchange));
  }
  return Evaluator(std::make_unique<EvaluatorImpl<Pack<4>>>(
      system, first_chain, num_chains, first_point, num_points, exchange));
}

}  // namespace dynamics
