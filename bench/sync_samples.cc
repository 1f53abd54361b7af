#include "bench/sync_samples.h"

#include <algorithm>
#include <map>
#include <memory>
#include <tuple>
#include <utility>

#include "bench/statistics.h"
#include "bench/sync_operations.h"
#include "macrotask/placement.h"

namespace bench {
namespace {

constexpr long kMostCalls = 1l << 24;
constexpr long kMostMarkedCalls = 4096;
// A race for a lock lasts so long, or several time slices of the system.
constexpr double kRaceSeconds = 5e-3;
constexpr double kCrowdedRaceSeconds = 20e-3;
// Tries to get a sample, or a reference, that nobody disturbed.
constexpr int kTries = 3;

bool HasProcessorEach(const Variant& variant) {
  return variant.num_tasks <= macrotask::NumProcessors();
}

std::optional<double> MedianIfAny(const std::vector<double>& values) {
  if (values.empty()) return std::nullopt;
  return Median(values);
}

// Runs the samples of the variants in one order again and again.
class Sampler {
 public:
  Sampler(const SamplingOptions& options, std::vector<SyncSeries>* series)
      : options_(options), rate_(MeasureDelayRate()), series_(*series) {}

  void FindCalls() {
    for (SyncSeries& series : series_) {
      if (!series.variant.missing.empty()) continue;
      series.calls = CallsForTarget(
          [&](long calls) {
            return Run(series.variant, SpecOf(series.variant, calls)).seconds;
          },
          TargetOf(series.variant), MostCalls(series.variant));
    }
  }

  void SampleOnce(bool keep) {
    references_.clear();
    Conditions now = probe_.Look();
    for (SyncSeries& series : series_) {
      if (!series.variant.missing.empty()) continue;
      const double reference = ReferenceOf(series.variant);
      for (int i = 0; i < kTries; ++i) {
        SyncSample sample = Sample(series);
        sample.reference = reference;
        sample.conditions.before = std::exchange(now, probe_.Look());
        sample.conditions.after = now;
        if (keep) series.samples.push_back(sample);
        if (!LostProcessor(sample.conditions)) break;
      }
    }
  }

 private:
  using ReferenceKey = std::tuple<int, double, Skew>;

  // More tasks than processors start one after the other, some 0.3 ms until the
  // last: that must not count.
  double TargetOf(const Variant& variant) const {
    constexpr double kCrowded = 10;
    return variant.num_tasks > macrotask::NumProcessors()
               ? kCrowded * options_.target
               : options_.target;
  }
  static long MostCalls(const Variant& variant) {
    return variant.timing == Timing::kWhole ? kMostMarkedCalls : kMostCalls;
  }

  LoopSpec SpecOf(const Variant& variant, long calls) const {
    const double late = variant.skew == Skew::kLate ? kLateMicroseconds : 0;
    return {.calls = calls,
            .work = DelaySteps(variant.work, rate_),
            .late = DelaySteps(late, rate_),
            .limit = options_.limit,
            .from_first_start = variant.serial || !HasProcessorEach(variant)};
  }

  LoopTiming Run(const Variant& variant, const LoopSpec& spec) const {
    if (variant.timing == Timing::kLoop) return variant.run(spec, nullptr);
    Marks marks(variant.num_tasks, spec.calls);
    return variant.run(spec, &marks);
  }

  SyncSample Sample(const SyncSeries& series) const;
  void AddLatencies(const SyncSeries& series, SyncSample* sample) const;
  void AddFairness(const Variant& variant, SyncSample* sample) const;
  double ReferenceOf(const Variant& variant);
  double MeasureReference(int num_tasks, const LoopSpec& spec) const;

  const SamplingOptions options_;
  const double rate_;  // of Delay()
  const ConditionsProbe probe_;
  std::vector<SyncSeries>& series_;
  std::map<ReferenceKey, double> references_;  // of this repetition
};

SyncSample Sampler::Sample(const SyncSeries& series) const {
  const Variant& variant = series.variant;
  SyncSample sample;
  if (variant.timing == Timing::kLoop) {
    const LoopTiming timing =
        variant.run(SpecOf(variant, series.calls), nullptr);
    const auto calls = static_cast<double>(variant.serial ? timing.total_calls()
                                                          : timing.calls[0]);
    sample.seconds = timing.seconds / calls;
    sample.cpu = timing.cpu / calls;
    sample.conditions.switches = timing.switches;
  }
  AddLatencies(series, &sample);
  if (variant.serial && variant.num_tasks > 1 && variant.work == 0) {
    AddFairness(variant, &sample);
  }
  // Tasks that share processors are switched all the time, and to create a
  // pthread or to wake one is to switch.
  if (!HasProcessorEach(variant) || variant.timing == Timing::kWhole) {
    sample.conditions.switches = 0;
  }
  return sample;
}

void Sampler::AddLatencies(const SyncSeries& series, SyncSample* sample) const {
  const Variant& variant = series.variant;
  if (variant.latency == LatencyKind::kNone) return;
  const long calls = std::min(series.calls, kMostMarkedCalls);
  Marks marks(variant.num_tasks, calls);
  const LoopTiming timing = variant.run(SpecOf(variant, calls), &marks);
  sample->conditions.switches += timing.switches;
  const std::vector<TaskMarks> tasks = marks.Take();
  const Latencies latencies = CalcLatencies(variant.latency, tasks);
  sample->first = MedianIfAny(latencies.first);
  sample->last = MedianIfAny(latencies.last);
  if (variant.timing == Timing::kWhole) {
    sample->seconds = Median(CalcWholes(tasks));
    sample->cpu = timing.cpu / static_cast<double>(timing.calls[0]);
  }
}

void Sampler::AddFairness(const Variant& variant, SyncSample* sample) const {
  LoopSpec spec = SpecOf(variant, kMostCalls);
  spec.race = true;
  spec.limit = HasProcessorEach(variant) ? kRaceSeconds : kCrowdedRaceSeconds;
  const LoopTiming timing = variant.run(spec, nullptr);
  sample->fairness = FairnessOf(timing.calls);
  sample->conditions.switches += timing.switches;
}

double Sampler::ReferenceOf(const Variant& variant) {
  if (variant.timing == Timing::kWhole) return 0;
  const int num_tasks = variant.serial ? 1 : variant.num_tasks;
  const ReferenceKey key = {num_tasks, variant.work, variant.skew};
  const auto known = references_.find(key);
  if (known != references_.end()) return known->second;
  // What tasks that share processors would need if these were always busy.
  const int at_once = std::min(num_tasks, macrotask::NumProcessors());
  LoopSpec spec = SpecOf(variant, 1);
  spec.work *= (num_tasks + at_once - 1) / at_once;
  const double reference = MeasureReference(at_once, spec);
  references_.emplace(key, reference);
  return reference;
}

double Sampler::MeasureReference(int num_tasks, const LoopSpec& once) const {
  const auto nothing = [] {};
  SimpleOperation<decltype(nothing)> operation(nothing);
  const Team team = MakePthreadTeam(num_tasks, SyncPlacement::kPinned);
  const auto run = [&](long calls) {
    LoopSpec spec = once;
    spec.calls = calls;
    spec.from_first_start = false;
    NoMarks none;
    return RunLoop(operation, team, spec, none);
  };
  const long calls = CallsForTarget([&](long n) { return run(n).seconds; },
                                    options_.target, kMostCalls);
  LoopTiming timing = run(calls);
  for (int i = 1; i < kTries && timing.switches > 0; ++i) {
    timing = run(calls);
  }
  return timing.seconds / static_cast<double>(timing.calls[0]);
}

}  // namespace

long CallsForTarget(const std::function<double(long)>& seconds, double target,
                    long most) {
  long calls = 1;
  while (calls < most && seconds(calls) < target) calls *= 2;
  return std::min(calls, most);
}

double FairnessOf(const std::vector<long>& calls) {
  const auto [fewest, most] = std::minmax_element(calls.begin(), calls.end());
  if (calls.empty() || *most == 0) return 1;
  return static_cast<double>(*fewest) / static_cast<double>(*most);
}

std::vector<SyncSeries> SampleAll(const std::vector<Variant>& variants,
                                  const SamplingOptions& options,
                                  const std::function<void(int, int)>& show) {
  std::vector<SyncSeries> series;
  for (const Variant& variant : variants) {
    series.push_back({.variant = variant, .calls = 0, .samples = {}});
  }
  Sampler sampler(options, &series);
  show(0, options.repetitions + 1);
  sampler.FindCalls();
  for (int r = 0; r <= options.repetitions; ++r) {
    show(r, options.repetitions + 1);
    sampler.SampleOnce(r > 0);
  }
  return series;
}

}  // namespace bench
