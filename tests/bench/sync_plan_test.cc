#include "bench/sync_plan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <tuple>

namespace bench {
namespace {

TEST(AllWaitKinds, HasEveryWayToWaitOnce) {
  const auto kinds = AllWaitKinds();
  for (const char* name : {"block", "spin", "hold"}) {
    EXPECT_EQ(
        std::count(kinds.begin(), kinds.end(), macrotask::ParseWaitKind(name)),
        1)
        << name;
  }
}

TEST(PlanVariants, HasEachVariantOnce) {
  std::set<std::tuple<std::string, std::string, int, double, Skew>> seen;
  SyncAxes axes;
  axes.works = {0, 1};
  axes.skews = {Skew::kZero, Skew::kLate};
  for (const Variant& v : PlanVariants(axes)) {
    EXPECT_TRUE(
        seen.emplace(v.construct, v.by, v.num_tasks, v.work, v.skew).second)
        << v.construct << " " << v.by;
  }
}

TEST(PlanVariants, HasOnlyTheFamiliesThatAreWanted) {
  SyncAxes axes;
  axes.families = {SyncFamily::kLock};
  for (const Variant& variant : PlanVariants(axes)) {
    EXPECT_EQ(variant.family, SyncFamily::kLock) << variant.construct;
  }
}

TEST(PlanVariants, HasAWayToRunEverythingThatIsNotMissing) {
  for (const Variant& variant : PlanVariants({})) {
    EXPECT_TRUE(variant.run || !variant.missing.empty())
        << variant.construct << " " << variant.by;
  }
}

TEST(PlanVariants, PutsWhatComparesTogether) {
  SyncAxes axes;
  axes.families = {SyncFamily::kBarrier};
  const auto variants = PlanVariants(axes);
  EXPECT_TRUE(std::is_sorted(variants.begin(), variants.end(),
                             [](const Variant& a, const Variant& b) {
                               return a.num_tasks < b.num_tasks;
                             }));
}

}  // namespace
}  // namespace bench
