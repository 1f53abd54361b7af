#pragma once

#include <exception>
#include <limits>
#include <span>
#include <string>
#include <vector>

namespace support {

// A small nonlinear system with a known solution, to be evaluated chain by
// chain: what the integrators see of four robots, without a robot. Chain k has
// two states, three if k is odd; the common state has two; the coupling is one
// number, which on the solution is a known function of time:
//
//   y_0 = sin(t + k), y_1 = cos(t + k), y_2 = exp(-t);  z = (cos t, sin t)
//   c   = sum_k (1 + k/10) y_k0 + z_0,  C(t) its value on the solution
class ModelSystem {
 public:
  // What the chain is to do from a time on, to see how a run ends.
  struct Fault {
    enum Kind { kNone, kFails, kThrows } kind = kNone;
    int chain = 0;
    double time = std::numeric_limits<double>::infinity();
  };

  explicit ModelSystem(int num_chains) : num_chains_(num_chains) {}
  ModelSystem(int num_chains, Fault fault)
      : num_chains_(num_chains), fault_(fault) {}

  int num_chains() const { return num_chains_; }
  int chain_size(int k) const { return k % 2 == 0 ? 2 : 3; }
  int common_size() const { return 2; }
  int coupling_size() const { return 1; }
  // "chain k fails", for the code k + 1.
  std::string DescribeFailure(int code) const;

  // The solution, a full state vector, and its derivative.
  std::vector<double> Solution(double t) const;
  std::vector<double> SolutionRate(double t) const;
  double SolutionCoupling(double t) const;

  struct Exchange {
    double& value(int set, int point, int k) {
      return values[static_cast<std::size_t>((set * points + point) * chains +
                                             k)];
    }
    int points, chains;
    std::vector<double> values;
  };
  Exchange MakeExchange(int num_points) const;

  class Evaluator {
   public:
    Evaluator(const ModelSystem& system, int first_chain, int num_chains,
              int first_point, int num_points, Exchange* exchange);
    void Ocd(int set, std::span<const double> times,
             std::span<const double* const> states);
    void Rma(int set, std::span<const double* const> states,
             std::span<double* const> rates, double* coupling,
             std::span<int> failures);
    void Ccd(const double* coupling, std::span<double* const> rates);
    std::exception_ptr TakeError();

   private:
    const ModelSystem& system_;
    int first_chain_, num_chains_, first_point_;
    Exchange& exchange_;
    std::vector<double> times_;
    std::vector<const double*> states_;
    std::exception_ptr error_;
  };
  Evaluator MakeEvaluator(int first_chain, int num_chains, int first_point,
                          int num_points, Exchange* exchange) const;

 private:
  int num_chains_;
  Fault fault_;
};

}  // namespace support
