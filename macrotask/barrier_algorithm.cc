#include "macrotask/barrier_algorithm.h"

#include <limits>

// What counts is how many transfers of a cache line follow one another when all
// n members arrive at once:
//
//   counter        n: everybody changes the one line, and the last change is
//                  the release
//   dissemination  2 ceil(log2 n): in a round one line is taken for writing and
//                  fetched by whoever waits, by all pairs at the same time
//   tree           2 a level and 2 for the release, and up to 3 fetches more a
//                  level; 3 levels below the root are good for 85 members
//
// For 2 the two tie, and so they do here with work between the phases: 170 to
// 200 ns a phase either way. Without work the counter is faster, 36 ns against
// 55, since the last to arrive has the line and is at once the first of the next
// phase (one process, interleaved, 2-processor KVM guest, Zen 4 class).
//
// For more it follows from the formulas, by which dissemination is ahead from 7
// on, and is not measured, for want of processors. But dissemination moves
// 2 n ceil(log2 n) lines a phase in all, the tree 3 n. Where all of them go
// through one interconnect, the tree wins in the end [Mellor-Crummey and Scott
// 1991, section 4]: from 33 on, where the sixth round would begin, it moves a
// quarter as many.

namespace macrotask {
namespace {

struct Choice {
  int most_tasks;
  BarrierAlgorithm algorithm;
};
constexpr Choice kChoices[] = {
    {6, BarrierAlgorithm::kCounter},
    {32, BarrierAlgorithm::kDissemination},
    {std::numeric_limits<int>::max(), BarrierAlgorithm::kTree},
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
    case BarrierAlgorithm::kTree:
      return "tree";
  }
  return "unknown";
}

std::optional<BarrierAlgorithm> ParseBarrierAlgorithm(std::string_view name) {
  for (BarrierAlgorithm algorithm :
       {BarrierAlgorithm::kAuto, BarrierAlgorithm::kCounter,
        BarrierAlgorithm::kDissemination, BarrierAlgorithm::kTree}) {
    if (name == Name(algorithm)) return algorithm;
  }
  return std::nullopt;
}

}  // namespace macrotask
