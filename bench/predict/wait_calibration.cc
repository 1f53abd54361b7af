#include "bench/predict/wait_calibration.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <optional>
#include <string>

#include "bench/sync_plan.h"

namespace bench::predict {
namespace {

using macrotask::WaitKind;

// As long as the blocks of the computation, or so.
constexpr double kWork = 0.5;  // us
// Longer than to fall asleep, for tasks that sleep at once.
constexpr double kLongWork = 10;  // us
constexpr int kFewTasks = 4, kManyTasks = 16;

// How long a task that sleeps at once takes until it does: the call of the
// kernel. Whoever is released before returns at once.
constexpr double kFallAsleep = 1e-6;  // s

constexpr const char* kBarsync = "BARSYNC";
constexpr const char* kDissemination = "BARSYNC, dissemination";
constexpr const char* kTree = "BARSYNC, tree";
constexpr const char* kEvent = "EVPOST to EVWAIT";

bool IsWanted(const Variant& variant) {
  if (variant.construct == kBarsync) {
    const bool sleeps = variant.by == Name(WaitKind::kBlock);
    if (variant.num_tasks > 2) {
      return variant.work == kWork && variant.skew == Skew::kZero;
    }
    return sleeps ? variant.work == kLongWork
                  : variant.work == kWork && variant.skew == Skew::kZero;
  }
  const bool for_two = variant.num_tasks == 2 && variant.work == kWork &&
                       variant.skew == Skew::kZero;
  return for_two && (variant.construct == kEvent ||
                     variant.construct == kDissemination ||
                     variant.construct == kTree);
}

// Looks rows up, at one distance if possible.
class Rows {
 public:
  Rows(const std::vector<SyncRow>& rows, Distance distance)
      : rows_(rows), distance_(distance) {}

  std::optional<double> Overhead(const char* construct, WaitKind wait,
                                 int num_tasks, Skew skew) const {
    const SyncRow* found = nullptr;
    for (const SyncRow& row : rows_) {
      const Variant& variant = row.variant;
      if (variant.construct != construct || variant.by != Name(wait) ||
          variant.num_tasks != num_tasks || variant.skew != skew ||
          !row.overhead) {
        continue;
      }
      if (found == nullptr || row.distance == distance_) found = &row;
    }
    if (found == nullptr) return {};
    return std::max(0.0, found->overhead->median);
  }

 private:
  const std::vector<SyncRow>& rows_;
  Distance distance_;
};

// n / P turn + shared_wake through both points; without the latter where it
// would be negative.
void FitCrowded(const Rows& rows, WaitKind wait, int processors,
                WaitCost* cost) {
  const auto few = rows.Overhead(kBarsync, wait, kFewTasks, Skew::kZero);
  const auto many = rows.Overhead(kBarsync, wait, kManyTasks, Skew::kZero);
  if (!few || !many) return;
  const double slope = (*many - *few) / (kManyTasks - kFewTasks);
  cost->shared_wake = std::max(0.0, *few - slope * kFewTasks);
  cost->turn = std::max(0.0, (*many - cost->shared_wake) / kManyTasks) *
               processors;
}

WaitCost FitWait(const Rows& rows, WaitKind wait, double line, int processors,
                 std::chrono::nanoseconds hold_time) {
  const WaitKind like =
      wait == WaitKind::kBlock ? WaitKind::kHold : wait;
  WaitCost cost;
  cost.post = line;
  cost.barrier.two = rows.Overhead(kBarsync, like, 2, Skew::kZero).value_or(0);
  cost.barrier.further = line;
  cost.barrier.round = rows.Overhead(kDissemination, like, 2, Skew::kZero);
  cost.barrier.level = rows.Overhead(kTree, like, 2, Skew::kZero);
  cost.event = rows.Overhead(kEvent, like, 2, Skew::kZero).value_or(0);
  cost.lock = cost.start = cost.event;
  FitCrowded(rows, wait, processors, &cost);
  if (wait == WaitKind::kSpin || wait == WaitKind::kLogical) return cost;
  const WaitKind sleeps = WaitKind::kBlock;
  cost.wake = rows.Overhead(kBarsync, sleeps, 2, Skew::kZero).value_or(0);
  cost.waker = rows.Overhead(kBarsync, sleeps, 2, Skew::kLate).value_or(0);
  cost.sleeps_after = wait == WaitKind::kBlock
                          ? kFallAsleep
                          : std::chrono::duration<double>(hold_time).count();
  return cost;
}

}  // namespace

WaitSampler::WaitSampler(std::chrono::nanoseconds hold_time) {
  SyncAxes axes;
  axes.families = {SyncFamily::kBarrier, SyncFamily::kEvent};
  axes.num_tasks = {2, kFewTasks, kManyTasks};
  axes.hold_time = hold_time;
  axes.works = {kWork, kLongWork};
  axes.skews = {Skew::kZero, Skew::kLate};
  std::vector<Variant> all;
  AddConstructs(axes, &all);
  std::copy_if(all.begin(), all.end(), std::back_inserter(variants_),
               &IsWanted);
}

void WaitSampler::Round(int repetitions) {
  std::vector<SyncSeries> round = SampleAll(
      variants_, {.repetitions = repetitions}, [](int, int) {});
  if (series_.empty()) {
    series_ = std::move(round);
    return;
  }
  for (std::size_t i = 0; i < round.size(); ++i) {
    std::move(round[i].samples.begin(), round[i].samples.end(),
              std::back_inserter(series_[i].samples));
  }
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
                                      Distance distance, double line,
                                      int processors,
                                      std::chrono::nanoseconds hold_time) {
  const Rows of(rows, distance);
  std::map<WaitKind, WaitCost> waits;
  for (const WaitKind wait : AllWaitKinds()) {
    waits.emplace(wait, FitWait(of, wait, line, processors, hold_time));
  }
  return waits;
}

}  // namespace bench::predict
