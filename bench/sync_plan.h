#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "bench/sync_team.h"
#include "bench/sync_variant.h"
#include "macrotask/wait_policy.h"

namespace bench {

// Every way to wait that the library has, by its Name().
std::vector<macrotask::WaitKind> AllWaitKinds();

// The axes: what is measured is all combinations that make sense.
struct SyncAxes {
  std::vector<SyncFamily> families;  // none: all
  std::vector<int> num_tasks = {2, 4, 16};
  std::vector<macrotask::WaitKind> waits = AllWaitKinds();
  std::chrono::nanoseconds hold_time = macrotask::kDefaultHoldTime;
  std::vector<double> works = {0, 1};  // us
  std::vector<Skew> skews = {Skew::kZero};
  SyncPlacement placement = SyncPlacement::kPinned;

  bool Wants(SyncFamily family) const;
  // The policies to measure.
  std::vector<macrotask::WaitPolicy> Policies() const;
};

// The rows of the tables: by family, number of tasks, work and skew, so that
// what compares stands together and is measured in turn; there ours, the peers,
// bare atomics. Throws std::invalid_argument if there are none.
std::vector<Variant> PlanVariants(const SyncAxes& axes);

// The parts of it, one file each. They add what `axes` wants of theirs.
void AddConstructs(const SyncAxes& axes, std::vector<Variant>* variants);
void AddPeers(const SyncAxes& axes, std::vector<Variant>* variants);
void AddBareAtomics(const SyncAxes& axes, std::vector<Variant>* variants);
void AddLimits(const SyncAxes& axes, std::vector<Variant>* variants);

// Calls add(num_tasks, work, skew) at each point of the axes with two tasks or
// more; unless `with_skew`, at zero skew only.
template <typename Add>
void ForEachPoint(const SyncAxes& axes, bool with_skew, const Add& add) {
  const std::vector<Skew> skews =
      with_skew ? axes.skews : std::vector<Skew>{Skew::kZero};
  for (const int num_tasks : axes.num_tasks) {
    if (num_tasks < 2) continue;
    for (const double work : axes.works) {
      for (const Skew skew : skews) add(num_tasks, work, skew);
    }
  }
}

}  // namespace bench
