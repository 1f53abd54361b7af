#include "macrotask/barrier_algorithm.h"

#include <limits>

// What counts is how many transfers of a cache line follow one another when all
// n members arrive at once:
//
//   counter        n: everybody changes the one line, and the last change is
//                  the release
//   dissemination  2 ceil(log2 n): in a round one line is taken for writing and
//                  fetched by whoever waits, by all pairs at the same time
//
// For 2 the two tie, and so they do here with work between the phases: 170 to
// 200 ns a phase either way. Without work the counter is faster, 36 ns against
// 55, since the last to arrive has the line and is at once the first of the next
// phase (one process, interleaved, 2-processor KVM guest, Zen 4 class).
//
// For more it follows from the formulas, by which dissemination is ahead from 7
// on, and is not measured, for want of processors.

namespace macrotask {
namespace {

struct Choice {
  int most_tasks;
  BarrierAlgorithm algorithm;
};
constexpr Choice kChoices[] = {
    {6, BarrierAlgorithm::kCounter},
    {std::numeric_limits<int>::max(), BarrierAlgorithm::kDissemination},
};

}  // namespace

BarrierAlgorithm ChooseBarrierAlgorithm(int num_tasks) {
  const Choice* choice = kChoices;
  while (num_tasks > choice->most_tasks) ++choice;
  return choice->algorithm;
}

std::string_view Name(BarrierAlgorithm algorithm) {
  switch (algorithm) {
    case BarrierAlgorithm::kAuto:
      return "auto";
    case BarrierAlgorithm::kCounter:
      return "counter";
    case BarrierAlgorithm::kDissemination:
      return "dissemination";
  }
  return "unknown";
}

std::optional<BarrierAlgorithm> ParseBarrierAlgorithm(std::string_view name) {
  for (BarrierAlgorithm algorithm :
       {BarrierAlgorithm::kAuto, BarrierAlgorithm::kCounter,
        BarrierAlgorithm::kDissemination}) {
    if (name == Name(algorithm)) return algorithm;
  }
  return std::nullopt;
}

}  // namespace macrotask
