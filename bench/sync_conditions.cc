#include "bench/sync_conditions.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>

#include "bench/statistics.h"
#include "bench/sync_bare.h"
#include "bench/sync_clock.h"
#include "macrotask/placement.h"
#include "macrotask/task.h"

namespace bench {
namespace {

// The median of a few short runs: one that lost its processor does not count.
double MeasureRoundTrip() {
  constexpr int kRuns = 9;
  constexpr int kTrips = 25;
  RoundTrip round_trip;
  std::vector<double> seconds;
  macrotask::RunTasks(2, [&](int task) {
    for (int run = 0; run < kRuns; ++run) {
      const std::uint64_t start = Ticks();
      for (int trip = 0; trip < kTrips; ++trip) round_trip.Call(task);
      if (task > 0) continue;
      seconds.push_back(SecondsBetween(start, Ticks()) / kTrips);
    }
  });
  return Median(seconds);
}

// The mean squared deviation of sorted [first, last), times their number.
class Spread {
 public:
  explicit Spread(const std::vector<double>& sorted)
      : sums_(sorted.size() + 1), squares_(sorted.size() + 1) {
    for (std::size_t i = 0; i < sorted.size(); ++i) {
      sums_[i + 1] = sums_[i] + sorted[i];
      squares_[i + 1] = squares_[i] + sorted[i] * sorted[i];
    }
  }

  double Of(std::size_t first, std::size_t last) const {
    const double sum = sums_[last] - sums_[first];
    return squares_[last] - squares_[first] -
           sum * sum / static_cast<double>(last - first);
  }

 private:
  std::vector<double> sums_, squares_;
};

}  // namespace

ConditionsProbe::ConditionsProbe()
    : stat_(open("/proc/stat", O_RDONLY | O_CLOEXEC)) {}

ConditionsProbe::~ConditionsProbe() {
  if (stat_ >= 0) close(stat_);
}

std::uint64_t ConditionsProbe::Stolen() const {
  char text[256];
  const ssize_t size = stat_ < 0 ? 0 : pread(stat_, text, sizeof text, 0);
  return size > 0 ? StolenTicks({text, static_cast<std::size_t>(size)}) : 0;
}

Conditions ConditionsProbe::Look() const {
  return {
      .round_trip = macrotask::NumProcessors() >= 2 ? MeasureRoundTrip() : 0,
      .stolen = Stolen()};
}

std::uint64_t StolenTicks(std::string_view stat) {
  constexpr int kStealWord = 8;  // behind "cpu"
  const std::string_view line = stat.substr(0, stat.find('\n'));
  std::size_t word = 0;
  for (int i = 0; i < kStealWord; ++i) {
    word = line.find(' ', word);
    if (word == std::string_view::npos) return 0;
    word = line.find_first_not_of(' ', word);
    if (word == std::string_view::npos) return 0;
  }
  return std::strtoull(std::string(line.substr(word)).c_str(), nullptr, 10);
}

std::string_view Name(Distance distance) {
  switch (distance) {
    case Distance::kOnly:
      return "";
    case Distance::kNear:
      return "near";
    case Distance::kFar:
      return "far";
  }
  return "unknown";
}

bool DistanceSplit::has_two() const { return std::isfinite(threshold); }

Distance DistanceSplit::Of(double round_trip) const {
  if (!has_two()) return Distance::kOnly;
  return round_trip < threshold ? Distance::kNear : Distance::kFar;
}

DistanceSplit SplitDistances(std::vector<double> round_trips) {
  const DistanceSplit one = {std::numeric_limits<double>::infinity()};
  std::erase_if(round_trips, [](double trip) { return !(trip > 0); });
  for (double& trip : round_trips) trip = std::log(trip);
  std::sort(round_trips.begin(), round_trips.end());
  const std::size_t n = round_trips.size();
  const auto least =
      static_cast<std::size_t>(std::ceil(kLeastShare * static_cast<double>(n)));
  if (n < 2 || 2 * least > n) return one;
  const Spread spread(round_trips);
  std::size_t best = least;
  for (std::size_t i = least; i + least <= n; ++i) {
    if (spread.Of(0, i) + spread.Of(i, n) <
        spread.Of(0, best) + spread.Of(best, n)) {
      best = i;
    }
  }
  const auto middle = round_trips.begin() + static_cast<std::ptrdiff_t>(best);
  const double near = Median({round_trips.begin(), middle});
  const double far = Median({middle, round_trips.end()});
  if (far - near < std::log(kLeastRatio)) return one;
  return {std::exp((round_trips[best - 1] + round_trips[best]) / 2)};
}

bool LostProcessor(const SampleConditions& sample) {
  return sample.after.stolen > sample.before.stolen || sample.switches > 0;
}

Disturbance JudgeSample(const SampleConditions& sample,
                        const DistanceSplit& split) {
  if (sample.after.stolen > sample.before.stolen) return Disturbance::kStolen;
  if (sample.switches > 0) return Disturbance::kSwitched;
  return split.Of(sample.before.round_trip) == split.Of(sample.after.round_trip)
             ? Disturbance::kNone
             : Disturbance::kDistance;
}

void Dropped::Add(Disturbance disturbance) {
  distance += disturbance == Disturbance::kDistance;
  stolen += disturbance == Disturbance::kStolen;
  switched += disturbance == Disturbance::kSwitched;
}

}  // namespace bench
