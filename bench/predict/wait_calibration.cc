#include "bench/predict/wait_calibration.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <optional>
#include <string_view>
#include <utility>

#include "bench/sync_plan.h"

namespace bench::predict {
namespace {

using macrotask::WaitKind;

// As long as the blocks of the computation, or so.
constexpr double kWork = 0.5;  // us
// Of tasks that share processors: what a turn costs must show beside the work.
constexpr double kNoWork = 0;  // us
// Longer than to fall asleep, for tasks that sleep at once.
constexpr double kLongWork = 10;  // us
constexpr int kFewTasks = 4, kManyTasks = 16;

// How long a task that sleeps at once takes until it does: the call of the
// kernel. Whoever is released before returns at once.
constexpr double kFallAsleep = 1e-6;  // s

constexpr const char* kBarsync = "BARSYNC";
constexpr const char* kCounter = "BARSYNC, counter";
constexpr const char* kDissemination = "BARSYNC, dissemination";
constexpr const char* kTree = "BARSYNC, tree";
constexpr const char* kEvent = "EVPOST to EVWAIT";
constexpr const char* kFutex = "futex wake to running";

bool IsCrowded(const Variant& variant) { return variant.num_tasks > 2; }

bool IsWanted(const Variant& variant) {
  if (variant.construct == kFutex) return true;
  if (IsCrowded(variant)) {
    return variant.construct == kBarsync && variant.work == kNoWork;
  }
  const bool sleeps = variant.by == Name(WaitKind::kBlock);
  if (sleeps) return variant.construct == kBarsync && variant.work == kLongWork;
  const bool anonymous = variant.construct == kBarsync;
  const bool logical = variant.by == Name(WaitKind::kLogical);
  return variant.work == kWork &&
         (anonymous
              ? logical
              : variant.construct == kEvent || variant.construct == kCounter ||
                    variant.construct == kDissemination ||
                    variant.construct == kTree);
}

// Looks rows up, at one distance if possible.
class Rows {
 public:
  Rows(const std::vector<SyncRow>& rows, Distance distance)
      : rows_(rows), distance_(distance) {}

  std::optional<double> Overhead(const char* construct, std::string_view by,
                                 int num_tasks) const {
    const SyncRow* found = nullptr;
    for (const SyncRow& row : rows_) {
      const Variant& variant = row.variant;
      if (variant.construct != construct || variant.by != by ||
          variant.num_tasks != num_tasks || !row.overhead) {
        continue;
      }
      if (found == nullptr || row.distance == distance_) found = &row;
    }
    if (found == nullptr) return {};
    return std::max(0.0, found->overhead->median);
  }

  // Of two tasks that do not sleep.
  std::optional<double> Awake(const char* construct) const {
    const auto hold = Overhead(construct, Name(WaitKind::kHold), 2);
    const auto spin = Overhead(construct, Name(WaitKind::kSpin), 2);
    if (hold && spin) return (*hold + *spin) / 2;
    return hold ? hold : spin;
  }

 private:
  const std::vector<SyncRow>& rows_;
  Distance distance_;
};

// n / P turn + shared_wake through both points. Where the latter would be
// negative, n / P turn alone, as far above the one as below the other.
void FitCrowded(const Rows& rows, WaitKind wait, int processors,
                WaitCost* cost) {
  const auto few = rows.Overhead(kBarsync, Name(wait), kFewTasks);
  const auto many = rows.Overhead(kBarsync, Name(wait), kManyTasks);
  if (!few || !many) return;
  const double slope = (*many - *few) / (kManyTasks - kFewTasks);
  cost->shared_wake = std::max(0.0, *few - slope * kFewTasks);
  cost->turn =
      processors * (cost->shared_wake > 0
                        ? std::max(0.0, slope)
                        : std::sqrt(*few / kFewTasks * *many / kManyTasks));
}

WaitCost FitWait(const Rows& rows, WaitKind wait, double one_way,
                 int processors, std::chrono::nanoseconds hold_time) {
  const std::string_view logical = Name(WaitKind::kLogical);
  WaitCost cost;
  cost.post = one_way;
  cost.barrier.further = one_way;
  FitCrowded(rows, wait, processors, &cost);
  if (wait == WaitKind::kLogical) {
    cost.barrier.two = rows.Overhead(kBarsync, logical, 2).value_or(0);
    cost.event = rows.Overhead(kEvent, logical, 2).value_or(0);
    cost.lock = cost.start = cost.event;
    return cost;
  }
  cost.barrier.two = rows.Awake(kCounter).value_or(0);
  cost.barrier.round = rows.Awake(kDissemination);
  cost.barrier.level = rows.Awake(kTree);
  cost.event = rows.Awake(kEvent).value_or(0);
  cost.lock = cost.start = cost.event;
  if (wait == WaitKind::kSpin) return cost;
  cost.wake = rows.Overhead(kBarsync, Name(WaitKind::kBlock), 2).value_or(0);
  cost.waker = rows.Overhead(kFutex, "Linux", 2).value_or(0);
  cost.sleeps_after = wait == WaitKind::kBlock
                          ? kFallAsleep
                          : std::chrono::duration<double>(hold_time).count();
  return cost;
}

}  // namespace

WaitSampler::WaitSampler(std::chrono::nanoseconds hold_time) {
  SyncAxes axes;
  axes.num_tasks = {2, kFewTasks, kManyTasks};
  axes.families = {SyncFamily::kBarrier, SyncFamily::kEvent};
  axes.hold_time = hold_time;
  axes.works = {kNoWork, kWork, kLongWork};
  std::vector<Variant> all;
  AddConstructs(axes, &all);
  AddLimits(axes, &all);
  for (const Variant& variant : all) {
    if (IsWanted(variant)) series_.push_back({variant, 0, {}});
  }
}

void WaitSampler::Sample(int row) {
  SyncSeries& series = series_[static_cast<std::size_t>(row)];
  std::vector<SyncSeries> sampled =
      SampleAll({series.variant}, {.repetitions = 1}, [](int, int) {});
  series.calls = sampled[0].calls;
  std::move(sampled[0].samples.begin(), sampled[0].samples.end(),
            std::back_inserter(series.samples));
}

std::vector<double> WaitSampler::round_trips() const {
  std::vector<double> trips;
  for (const SyncSeries& one : series_) {
    for (const SyncSample& sample : one.samples) {
      trips.push_back(sample.conditions.before.round_trip);
    }
  }
  return trips;
}

std::map<WaitKind, WaitCost> FitWaits(const std::vector<SyncRow>& rows,
                                      Distance distance, double one_way,
                                      int processors,
                                      std::chrono::nanoseconds hold_time) {
  const Rows of(rows, distance);
  std::map<WaitKind, WaitCost> waits;
  for (const WaitKind wait : AllWaitKinds()) {
    waits.emplace(wait, FitWait(of, wait, one_way, processors, hold_time));
  }
  return waits;
}

}  // namespace bench::predict
