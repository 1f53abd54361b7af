#include "bench/sync_break_even.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "bench/sync_operations.h"
#include "bench/sync_samples.h"
#include "macrotask/placement.h"

namespace bench {
namespace {

constexpr double kLeastWork = 0.01;  // us
constexpr double kFactor = 2;
constexpr int kNumWorks = 18;  // up to 1.3 ms
constexpr double kTarget = 1e-3;
constexpr double kLimit = 50e-3;

// Tries to get a point that nobody disturbed.
constexpr int kTries = 3;

// One repetition of one barrier: all works in turn.
struct Curve {
  std::vector<std::optional<EfficiencyPoint>> points;  // none: disturbed
  SampleConditions conditions;

  std::vector<EfficiencyPoint> Undisturbed() const {
    std::vector<EfficiencyPoint> undisturbed;
    for (const auto& point : points) {
      if (point) undisturbed.push_back(*point);
    }
    return undisturbed;
  }
};

std::vector<double> Works() {
  std::vector<double> works;
  for (int i = 0; i < kNumWorks; ++i) {
    works.push_back(kLeastWork * std::pow(kFactor, i));
  }
  return works;
}

double SecondsPerCall(const LoopTiming& timing) {
  return timing.seconds / static_cast<double>(timing.calls[0]);
}

// Enough calls of a loop for a sample, found once for each loop.
class TimedLoop {
 public:
  using Run = std::function<LoopTiming(const LoopSpec&)>;

  TimedLoop(long work, Run run) : work_(work), run_(std::move(run)) {
    calls_ = CallsForTarget([&](long calls) { return Time(calls).seconds; },
                            kTarget, 1l << 24);
  }

  LoopTiming Time() const { return Time(calls_); }

 private:
  LoopTiming Time(long calls) const {
    return run_({.calls = calls, .work = work_, .limit = kLimit});
  }

  long work_;
  Run run_;
  long calls_;
};

// What one task needs for the work of both, half of it: the work, as it is.
std::vector<TimedLoop> SerialLoops(double rate) {
  const auto run = [](const LoopSpec& spec) {
    const auto nothing = [] {};
    SimpleOperation<decltype(nothing)> operation(nothing);
    NoMarks none;
    return RunLoop(operation, MakePthreadTeam(1, SyncPlacement::kPinned), spec,
                   none);
  };
  std::vector<TimedLoop> loops;
  for (const double work : Works()) {
    loops.emplace_back(DelaySteps(work, rate), run);
  }
  return loops;
}

std::vector<TimedLoop> ParallelLoops(const Variant& barrier, double rate) {
  const auto run = [barrier](const LoopSpec& spec) {
    return barrier.run(spec, nullptr);
  };
  std::vector<TimedLoop> loops;
  for (const double work : Works()) {
    loops.emplace_back(DelaySteps(work, rate), run);
  }
  return loops;
}

std::optional<EfficiencyPoint> MeasurePoint(const TimedLoop& serial,
                                            const TimedLoop& parallel,
                                            const ConditionsProbe& probe) {
  for (int i = 0; i < kTries; ++i) {
    const std::uint64_t stolen = probe.Stolen();
    const LoopTiming one = serial.Time();
    const LoopTiming both = parallel.Time();
    if (one.switches + both.switches > 0 || probe.Stolen() > stolen) continue;
    const double work = SecondsPerCall(one);
    return EfficiencyPoint{work, work / SecondsPerCall(both)};
  }
  return std::nullopt;
}

Curve MeasureCurve(const std::vector<TimedLoop>& serial,
                   const std::vector<TimedLoop>& parallel,
                   const ConditionsProbe& probe) {
  Curve curve;
  curve.conditions.before = probe.Look();
  for (std::size_t i = 0; i < serial.size(); ++i) {
    curve.points.push_back(MeasurePoint(serial[i], parallel[i], probe));
  }
  curve.conditions.after = probe.Look();
  return curve;
}

std::vector<CurvePoint> MedianCurve(const std::vector<Curve>& curves) {
  std::vector<CurvePoint> medians;
  for (std::size_t i = 0; i < kNumWorks; ++i) {
    std::vector<double> works, efficiencies;
    for (const Curve& curve : curves) {
      if (!curve.points[i]) continue;
      works.push_back(curve.points[i]->work);
      efficiencies.push_back(curve.points[i]->efficiency);
    }
    if (works.empty()) continue;
    medians.push_back(
        {Median(works), Median(efficiencies), MedianInterval(efficiencies)});
  }
  return medians;
}

BreakEvenRow MakeRow(const Variant& barrier, const std::vector<Curve>& curves,
                     const DistanceSplit& split, Distance distance) {
  BreakEvenRow row = {.construct = barrier.construct,
                      .by = barrier.by,
                      .distance = distance,
                      .half = {},
                      .ninety = {},
                      .curve = {}};
  std::vector<Curve> kept;
  for (const Curve& curve : curves) {
    if (split.Of(curve.conditions.before.round_trip) != distance) continue;
    const auto undisturbed = curve.Undisturbed();
    row.points_dropped += kNumWorks - static_cast<int>(undisturbed.size());
    if (split.Of(curve.conditions.after.round_trip) != distance ||
        undisturbed.empty()) {
      ++row.dropped;
    } else {
      kept.push_back(curve);
    }
  }
  if (kept.empty()) return row;
  row.n = static_cast<int>(kept.size());
  row.curve = MedianCurve(kept);
  row.half = SummarizeWork(row.curve, 0.5);
  row.ninety = SummarizeWork(row.curve, 0.9);
  return row;
}

std::vector<double> RoundTripsOf(
    const std::vector<std::vector<Curve>>& curves) {
  std::vector<double> round_trips;
  for (const auto& of_barrier : curves) {
    for (const Curve& curve : of_barrier) {
      round_trips.push_back(curve.conditions.after.round_trip);
    }
  }
  return round_trips;
}

std::vector<Variant> Barriers(const SyncAxes& axes) {
  SyncAxes two = axes;
  two.families = {SyncFamily::kBarrier};
  two.num_tasks = {2};
  two.works = {0};
  two.skews = {Skew::kZero};
  std::vector<Variant> barriers = PlanVariants(two);
  std::erase_if(barriers, [](const Variant& barrier) {
    return !barrier.missing.empty();
  });
  return barriers;
}

// By barrier and repetition, of which the first is dropped.
std::vector<std::vector<Curve>> MeasureCurves(
    const std::vector<Variant>& barriers, int repetitions,
    const std::function<void(int, int)>& show) {
  const double rate = MeasureDelayRate();
  const std::vector<TimedLoop> serial = SerialLoops(rate);
  std::vector<std::vector<TimedLoop>> parallel;
  for (const Variant& barrier : barriers) {
    parallel.push_back(ParallelLoops(barrier, rate));
  }
  const ConditionsProbe probe;
  std::vector<std::vector<Curve>> curves(barriers.size());
  for (int r = 0; r <= repetitions; ++r) {
    show(r, repetitions + 1);
    for (std::size_t b = 0; b < barriers.size(); ++b) {
      Curve curve = MeasureCurve(serial, parallel[b], probe);
      if (r > 0) curves[b].push_back(std::move(curve));
    }
  }
  return curves;
}

}  // namespace

std::optional<double> LeastWork(const std::vector<EfficiencyPoint>& points,
                                double target) {
  std::size_t above = points.size();
  while (above > 0 && points[above - 1].efficiency >= target) --above;
  if (above == points.size()) return std::nullopt;
  if (above == 0) return points[0].work;
  const EfficiencyPoint& low = points[above - 1];
  const EfficiencyPoint& high = points[above];
  const double share =
      (target - low.efficiency) / (high.efficiency - low.efficiency);
  return low.work * std::pow(high.work / low.work, share);
}

WorkSummary SummarizeWork(const std::vector<CurvePoint>& curve, double target) {
  std::vector<EfficiencyPoint> medians, lower, upper;
  for (const CurvePoint& point : curve) {
    medians.push_back({point.work, point.efficiency});
    lower.push_back({point.work, point.interval.low});
    upper.push_back({point.work, point.interval.high});
  }
  return {.median = LeastWork(medians, target),
          .low = LeastWork(upper, target),
          .high = LeastWork(lower, target)};
}

BreakEven MeasureBreakEven(const SyncAxes& axes, int repetitions,
                           const std::function<void(int, int)>& show) {
  if (macrotask::NumProcessors() < 2) {
    throw std::invalid_argument(
        "--break-even needs 2 processors: this process may use 1");
  }
  show(0, repetitions + 1);
  const std::vector<Variant> barriers = Barriers(axes);
  const auto curves = MeasureCurves(barriers, repetitions, show);
  BreakEven result = {.split = {},
                      .least_work = Works().front() * 1e-6,
                      .most_work = Works().back() * 1e-6,
                      .round_trips = RoundTripsOf(curves),
                      .rows = {}};
  result.split = SplitDistances(result.round_trips);
  for (std::size_t b = 0; b < barriers.size(); ++b) {
    for (const Distance distance :
         {Distance::kOnly, Distance::kNear, Distance::kFar}) {
      if ((distance == Distance::kOnly) == result.split.has_two()) continue;
      result.rows.push_back(
          MakeRow(barriers[b], curves[b], result.split, distance));
    }
  }
  return result;
}

}  // namespace bench
