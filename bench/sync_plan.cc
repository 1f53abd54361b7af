#include "bench/sync_plan.h"

#include <algorithm>
#include <stdexcept>
#include <tuple>

namespace bench {

std::vector<macrotask::WaitKind> AllWaitKinds() {
  constexpr int kMoreThanThereAre = 16;
  std::vector<macrotask::WaitKind> kinds;
  for (int i = 0; i < kMoreThanThereAre; ++i) {
    const auto kind = static_cast<macrotask::WaitKind>(i);
    // kAuto is one of the others.
    if (kind == macrotask::WaitKind::kAuto) continue;
    if (macrotask::ParseWaitKind(Name(kind)) == kind) kinds.push_back(kind);
  }
  return kinds;
}

std::string_view Name(SyncFamily family) {
  switch (family) {
    case SyncFamily::kBarrier:
      return "barrier";
    case SyncFamily::kEvent:
      return "event";
    case SyncFamily::kLock:
      return "lock";
    case SyncFamily::kTask:
      return "task";
    case SyncFamily::kLimit:
      return "limit";
  }
  return "unknown";
}

std::string_view Name(Skew skew) {
  return skew == Skew::kZero ? "zero" : "late";
}

bool SyncAxes::Wants(SyncFamily family) const {
  return families.empty() ||
         std::find(families.begin(), families.end(), family) != families.end();
}

std::vector<macrotask::WaitPolicy> SyncAxes::Policies() const {
  std::vector<macrotask::WaitPolicy> policies;
  for (const macrotask::WaitKind kind : waits) {
    policies.push_back({.kind = kind, .hold_time = hold_time});
  }
  return policies;
}

std::vector<Variant> PlanVariants(const SyncAxes& axes) {
  std::vector<Variant> variants;
  AddConstructs(axes, &variants);
  AddPeers(axes, &variants);
  AddBareAtomics(axes, &variants);
  if (axes.Wants(SyncFamily::kLimit)) AddLimits(axes, &variants);
  const auto key = [](const Variant& variant) {
    return std::tuple(variant.family, variant.num_tasks, variant.work,
                      variant.skew);
  };
  std::stable_sort(
      variants.begin(), variants.end(),
      [&](const Variant& a, const Variant& b) { return key(a) < key(b); });
  if (variants.empty()) {
    throw std::invalid_argument(
        "nothing to measure: these constructs need 2 tasks or more");
  }
  return variants;
}

}  // namespace bench
