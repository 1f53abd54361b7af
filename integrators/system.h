#pragma once

#include <concepts>
#include <exception>
#include <memory>
#include <span>
#include <string>
#include <utility>

namespace integrators {

// One task's share of every derivative evaluation, as a system offers it: the
// blocks of Figure 1 for some chains at some points. Pairs of (chain, point)
// are numbered point by point: pair = point * chains + chain, both counted from
// the task's first. `set` is 0 or 1; successive evaluations alternate, because
// a task may begin the next one while another still reads this one's results.
template <typename E>
concept ChainEvaluator = requires(
    E evaluator, int set, std::span<const double> times,
    std::span<const double* const> states, std::span<double* const> derivatives,
    double* coupling, const double* given_coupling, std::span<int> failures) {
  // OCD: everything that a chain can compute from its own state.
  evaluator.Ocd(set, times, states);
  // RMA: what couples the chains, from all chains' OCD and the common state.
  // `failures` receives 0 a point, or a code of the system's own.
  evaluator.Rma(set, states, derivatives, coupling, failures);
  // CCD: the derivatives of the chains' states.
  evaluator.Ccd(given_coupling, derivatives);
  // What the system's user code threw since the last call, if it did.
  { evaluator.TakeError() } -> std::same_as<std::exception_ptr>;
};

// A system of ordinary differential equations that can be evaluated chain by
// chain: m chains, each with a state of its own, and a common state (the
// reference member), coupled by a few numbers a point (its acceleration).
template <typename S>
concept ChainSystem = requires(const S& system, int i) {
  { system.num_chains() } -> std::convertible_to<int>;
  { system.chain_size(i) } -> std::convertible_to<int>;
  { system.common_size() } -> std::convertible_to<int>;
  { system.coupling_size() } -> std::convertible_to<int>;
  // Slots through which the chains' OCD reaches RMA, at i points.
  system.MakeExchange(i);
  requires requires(decltype(system.MakeExchange(i))* exchange) {
    // first chain, chains, first point, points
    { system.MakeEvaluator(i, i, i, i, exchange) } -> ChainEvaluator;
  };
  // What a code of Rma means, as part of a sentence.
  { system.DescribeFailure(i) } -> std::convertible_to<std::string>;
};

// The same, erased: so that the figures are ordinary functions, compiled once,
// and give the same bits to every caller. It costs one indirect call a block of
// Figure 1.
class Evaluation {
 public:
  virtual ~Evaluation() = default;
  virtual void Ocd(int set, std::span<const double> times,
                   std::span<const double* const> chain_states) = 0;
  virtual void Rma(int set, std::span<const double* const> common_states,
                   std::span<double* const> common_derivatives,
                   double* coupling, std::span<int> failures) = 0;
  virtual void Ccd(const double* coupling,
                   std::span<double* const> chain_derivatives) = 0;
  virtual std::exception_ptr TakeError() = 0;
};

// Makes the evaluations of one run; `num_points` points share its slots.
class EvaluationFactory {
 public:
  virtual ~EvaluationFactory() = default;
  virtual std::unique_ptr<Evaluation> Make(int first_chain, int num_chains,
                                           int first_point, int num_points) = 0;
};

class System {
 public:
  virtual ~System() = default;
  virtual int num_chains() const = 0;
  virtual int chain_size(int k) const = 0;
  virtual int common_size() const = 0;
  virtual int coupling_size() const = 0;
  virtual std::unique_ptr<EvaluationFactory> MakeFactory(
      int num_points) const = 0;
  virtual std::string DescribeFailure(int code) const = 0;
};

// Erases a chain system. `system` must outlive the result.
template <ChainSystem S>
class SystemOf final : public System {
 public:
  explicit SystemOf(const S& system) : system_(system) {}

  int num_chains() const override { return system_.num_chains(); }
  int chain_size(int k) const override { return system_.chain_size(k); }
  int common_size() const override { return system_.common_size(); }
  int coupling_size() const override { return system_.coupling_size(); }
  std::unique_ptr<EvaluationFactory> MakeFactory(
      int num_points) const override {
    return std::make_unique<Factory>(system_, num_points);
  }
  std::string DescribeFailure(int code) const override {
    return system_.DescribeFailure(code);
  }

 private:
  template <typename E>
  class EvaluationOf final : public Evaluation {
   public:
    explicit EvaluationOf(E evaluator) : evaluator_(std::move(evaluator)) {}
    void Ocd(int set, std::span<const double> times,
             std::span<const double* const> chain_states) override {
      evaluator_.Ocd(set, times, chain_states);
    }
    void Rma(int set, std::span<const double* const> common_states,
             std::span<double* const> common_derivatives, double* coupling,
             std::span<int> failures) override {
      evaluator_.Rma(set, common_states, common_derivatives, coupling,
                     failures);
    }
    void Ccd(const double* coupling,
             std::span<double* const> chain_derivatives) override {
      evaluator_.Ccd(coupling, chain_derivatives);
    }
    std::exception_ptr TakeError() override { return evaluator_.TakeError(); }

   private:
    E evaluator_;
  };

  class Factory final : public EvaluationFactory {
   public:
    Factory(const S& system, int num_points)
        : system_(system), exchange_(system.MakeExchange(num_points)) {}
    std::unique_ptr<Evaluation> Make(int first_chain, int num_chains,
                                     int first_point, int num_points) override {
      using E = decltype(system_.MakeEvaluator(0, 0, 0, 0, &exchange_));
      return std::make_unique<EvaluationOf<E>>(system_.MakeEvaluator(
          first_chain, num_chains, first_point, num_points, &exchange_));
    }

   private:
    const S& system_;
    decltype(std::declval<const S&>().MakeExchange(0)) exchange_;
  };

  const S& system_;
};

}  // namespace integrators
