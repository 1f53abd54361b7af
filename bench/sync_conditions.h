#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

// What a shared machine does to a sample, and which samples to believe.

namespace bench {

// The machine at one moment.
struct Conditions {
  double round_trip = 0;     // s, cache line there and back; 0: one processor
  std::uint64_t stolen = 0;  // ticks other guests took from us since the start
};

// Looks at the machine. Takes some 50 us.
class ConditionsProbe {
 public:
  ConditionsProbe();
  ~ConditionsProbe();
  ConditionsProbe(const ConditionsProbe&) = delete;
  ConditionsProbe& operator=(const ConditionsProbe&) = delete;

  Conditions Look() const;
  std::uint64_t Stolen() const;  // that part of it, which takes a microsecond

 private:
  int stat_;  // /proc/stat, or -1
};

// The eighth word of the first line of /proc/stat, "steal"; 0 if there is none.
std::uint64_t StolenTicks(std::string_view stat);

// The physical distance of the two processors, by round trips. A virtual
// machine's may change while one watches.
enum class Distance { kOnly, kNear, kFar };

std::string_view Name(Distance distance);

// Separates near from far.
struct DistanceSplit {
  double threshold;  // s; infinite if there is one distance only

  bool has_two() const;
  Distance Of(double round_trip) const;
};

// Splits round trips where the two halves are tightest, in the logarithm. One
// distance only if the medians of the two differ by less than a factor of
// `kLeastRatio` or one half has less than `kLeastShare` of all.
inline constexpr double kLeastRatio = 1.6;
inline constexpr double kLeastShare = 0.03;
DistanceSplit SplitDistances(std::vector<double> round_trips);

// Why a sample is not believed.
enum class Disturbance {
  kNone,
  kDistance,  // the processors came nearer or went away in it
  kStolen,    // another guest had a processor
  kSwitched,  // another thread had one
};
struct SampleConditions {
  Conditions before, after;
  long switches = 0;  // involuntary ones of tasks with a processor each
};
bool LostProcessor(const SampleConditions& sample);  // kStolen or kSwitched
Disturbance JudgeSample(const SampleConditions& sample,
                        const DistanceSplit& split);

// How many samples were dropped, by reason.
struct Dropped {
  int distance = 0, stolen = 0, switched = 0;

  int total() const { return distance + stolen + switched; }
  void Add(Disturbance disturbance);
};

}  // namespace bench
