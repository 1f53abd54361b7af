#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "dynamics/model.h"
#include "tests/support/kkt_oracle.h"

namespace support {

// Random numbers that are the same everywhere for the same seed.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  double Uniform(double low, double high);
  int Integer(int end);                                // 0 ... end - 1
  Eigen::VectorXd Vector(int size, double magnitude);  // each in +-magnitude
  Eigen::Matrix3d Rotation();
  Eigen::Isometry3d Pose(double reach);  // any axes, origin in +-reach
  Eigen::Matrix3d Inertia();  // positive definite, 0.02 to 0.2 kg m^2, any axes

 private:
  std::mt19937_64 engine_;
};

// An arm of `num_joints` links of random shape, about 2 kg and 0.4 m each, of
// which `num_prismatic`, anywhere along it, slide. Some have rotor inertia.
dynamics::ArmModel RandomArm(int num_joints, int num_prismatic, Random* random);

// The same at a random place, with a random grip.
dynamics::Chain RandomChain(int num_joints, int num_prismatic, Random* random);

// Joint positions at which the chain's J (6 x N, N >= 6) is well conditioned:
// the best of ten.
Eigen::VectorXd RandomRegularPosition(const dynamics::Chain& chain,
                                      Random* random);

// A random chain whose base has been put where, with the joint positions `q`
// (well conditioned), it carries the reference member at `pose`.
dynamics::Chain RandomChainHolding(const Eigen::Isometry3d& pose,
                                   int num_joints, int num_prismatic,
                                   Random* random, Eigen::VectorXd* q);

// A system, a state in which all chains hold the moving member, and torques.
struct RandomSystem {
  dynamics::SystemModel model;
  SystemState state;
  std::vector<Eigen::VectorXd> tau;  // (m)(N_k)
};

// One chain for each element of `num_joints` (each >= 6). One or two joints of
// every chain are prismatic. Joint rates beyond six are random within the null
// space of J.
RandomSystem MakeRandomSystem(const std::vector<int>& num_joints,
                              std::uint64_t seed);

}  // namespace support
