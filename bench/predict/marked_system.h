#pragma once

#include <exception>
#include <span>
#include <string>
#include <utility>

#include "bench/predict/marks.h"
#include "bench/sync_delay.h"
#include "integrators/system.h"

namespace bench::predict {

// What is done beside the evaluation of a system.
struct Extras {
  bool marks = false;  // leave marks: which block is computed from when on
  long work = 0;       // steps of Delay() for each chain at each point, in OCD
};

// A system that is evaluated as another one, with extras. The other one must
// outlive it.
template <integrators::ChainSystem S>
class SystemWith {
 public:
  SystemWith(const S& system, Extras extras)
      : system_(system), extras_(extras) {}

  int num_chains() const { return system_.num_chains(); }
  int chain_size(int k) const { return system_.chain_size(k); }
  int common_size() const { return system_.common_size(); }
  int coupling_size() const { return system_.coupling_size(); }
  auto MakeExchange(int num_points) const {
    return system_.MakeExchange(num_points);
  }
  std::string DescribeFailure(int code) const {
    return system_.DescribeFailure(code);
  }

  template <typename E>
  class EvaluatorWith {
   public:
    EvaluatorWith(E evaluator, bool marks, long work)
        : evaluator_(std::move(evaluator)), marks_(marks), work_(work) {}

    void Ocd(int set, std::span<const double> times,
             std::span<const double* const> states) {
      if (marks_) Mark(Block::kOcd);
      evaluator_.Ocd(set, times, states);
      Delay(work_);
    }
    void Rma(int set, std::span<const double* const> states,
             std::span<double* const> derivatives, double* coupling,
             std::span<int> failures) {
      if (marks_) Mark(Block::kRma);
      evaluator_.Rma(set, states, derivatives, coupling, failures);
    }
    void Ccd(const double* coupling, std::span<double* const> derivatives) {
      if (marks_) Mark(Block::kCcd);
      evaluator_.Ccd(coupling, derivatives);
      if (marks_) Mark(Block::kOther);
    }
    std::exception_ptr TakeError() { return evaluator_.TakeError(); }

   private:
    E evaluator_;
    bool marks_;
    long work_;
  };

  template <typename Exchange>
  auto MakeEvaluator(int first_chain, int num_chains, int first_point,
                     int num_points, Exchange* exchange) const {
    return EvaluatorWith(
        system_.MakeEvaluator(first_chain, num_chains, first_point, num_points,
                              exchange),
        extras_.marks, extras_.work * num_chains * num_points);
  }

 private:
  const S& system_;
  Extras extras_;
};

}  // namespace bench::predict
