#include "dynamics/plan.h"

#include <Eigen/QR>
#include <cmath>
#include <stdexcept>

#include "dynamics/chain_terms.h"
#include "dynamics/closed_chain_system.h"
#include "dynamics/kinematics.h"
#include "dynamics/ldlt.h"

namespace dynamics {
namespace {

MemberState<double> StateOf(const MemberMotion& motion) {
  const Eigen::Quaterniond Q(motion.pose.linear());
  return {.Q = {Q.w(), Q.x(), Q.y(), Q.z()},
          .p = motion.pose.translation(),
          .omega = motion.velocity.head<3>(),
          .v = motion.velocity.tail<3>()};
}

// Plans one chain, time by time.
class ChainPlanner {
 public:
  ChainPlanner(const SystemModel& model, int k, const Eigen::VectorXd& q_guess)
      : chain_(model.chains[k]),
        name_("chain " + std::to_string(k)),
        constants_(MakeChainConstants<double>({&chain_}, model.gravity)),
        terms_(chain_.arm.num_joints()),
        q_(q_guess),
        qd_(Eigen::VectorXd::Zero(q_guess.size())),
        qdd_(qd_) {
    if (q_guess.size() != chain_.arm.num_joints()) {
      throw std::invalid_argument(name_ + ": expected " +
                                  std::to_string(chain_.arm.num_joints()) +
                                  " joint positions to start from, got " +
                                  std::to_string(q_guess.size()));
    }
    joints_ = ChooseCarryingJoints(chain_, q_, name_ + " at t = 0.000000 s");
  }

  // Moves on to the time t: fills state, rate and torques for the motion while
  // the tip exerts f.
  void Plan(double t, const MemberMotion& motion, const Vector6<double>& f,
            Eigen::Ref<Eigen::VectorXd> state, Eigen::Ref<Eigen::VectorXd> rate,
            Eigen::Ref<Eigen::VectorXd> tau) {
    const std::string where = name_ + " at t = " + std::to_string(t) + " s";
    q_ = SolveInverseKinematics(chain_, motion.pose, joints_, q_, where);
    CalcChainTerms(constants_, q_.data(), qd_.data(), &terms_);
    Eigen::Matrix<double, 6, 6> J;
    for (int i = 0; i < 6; ++i) J.col(i) = Jacobian(terms_).col(joints_[i]);
    Eigen::ColPivHouseholderQR<Eigen::Matrix<double, 6, 6>> qr(J);
    qr.setThreshold(kSingularJacobian);
    if (qr.rank() < 6) {
      throw std::runtime_error(
          where + " is at a singularity (Lambda^-1 is not invertible)");
    }
    SetCarrying(qr.solve(motion.velocity), &qd_);  // (3)
    CalcChainTerms(constants_, q_.data(), qd_.data(), &terms_);
    Vector6<double> Jd_qd;
    Jd_qd << terms_.Jd_qd.angular, terms_.Jd_qd.linear;
    SetCarrying(qr.solve(motion.acceleration - Jd_qd), &qdd_);  // (4)
    state << q_, qd_;
    rate << qd_, qdd_;
    tau = CalcInverseDynamics(terms_, qdd_, f);  // (1)
  }

 private:
  void SetCarrying(const Vector6<double>& values, Eigen::VectorXd* all) {
    for (int i = 0; i < 6; ++i) (*all)[joints_[i]] = values[i];
  }

  const Chain& chain_;
  std::string name_;
  ChainConstants<double> constants_;
  ChainTerms<double> terms_;
  std::vector<int> joints_;
  Eigen::VectorXd q_, qd_, qdd_;
};

}  // namespace

LoadMotion StraightLift(const Eigen::Vector3d& start,
                        const Eigen::Vector3d& end, double duration) {
  return [=](double t) {
    const double s = std::fmin(std::fmax(t / duration, 0.0), 1.0);
    const double way = s * s * s * (10 + s * (-15 + 6 * s));
    const double rate = 30 * s * s * (1 - s) * (1 - s) / duration;
    const double rate2 = 60 * s * (1 - s) * (1 - 2 * s) / (duration * duration);
    MemberMotion motion;
    motion.pose = Eigen::Isometry3d::Identity();
    motion.pose.translation() = start + way * (end - start);
    motion.velocity << Eigen::Vector3d::Zero(), rate * (end - start);
    motion.acceleration << Eigen::Vector3d::Zero(), rate2 * (end - start);
    return motion;
  };
}

Plan MakePlan(const SystemModel& model, const LoadMotion& motion, double step,
              int num_steps, const std::vector<Eigen::VectorXd>& q_guess) {
  CheckModel(model);
  const int m = model.num_chains();
  if (static_cast<int>(q_guess.size()) != m) {
    throw std::invalid_argument("expected joint positions to start from for " +
                                std::to_string(m) + " chains, got " +
                                std::to_string(q_guess.size()));
  }
  Plan plan;
  plan.step = step;
  plan.member.resize(kMemberStateSize, num_steps + 1);
  plan.member_rate.resize(kMemberStateSize, num_steps + 1);
  std::vector<ChainPlanner> planners;
  for (int k = 0; k < m; ++k) {
    const int n = model.chains[k].arm.num_joints();
    planners.emplace_back(model, k, q_guess[k]);
    plan.states.emplace_back(2 * n, num_steps + 1);
    plan.rates.emplace_back(2 * n, num_steps + 1);
    plan.tau.emplace_back(n, num_steps + 1);
    plan.f.emplace_back(6, num_steps + 1);
  }
  for (int j = 0; j <= num_steps; ++j) {
    const double t = j * step;
    const MemberMotion at = motion(t);
    const MemberState<double> member = StateOf(at);
    PackMember(member, plan.member.col(j).data());
    PackMember(MemberDerivative(member, at.acceleration),
               plan.member_rate.col(j).data());
    const Vector6<double> share =
        CalcMemberForce(model.member, model.gravity, member, at.acceleration) /
        m;
    for (int k = 0; k < m; ++k) {
      plan.f[k].col(j) = share;
      planners[k].Plan(t, at, share, plan.states[k].col(j),
                       plan.rates[k].col(j), plan.tau[k].col(j));
    }
  }
  return plan;
}

}  // namespace dynamics
