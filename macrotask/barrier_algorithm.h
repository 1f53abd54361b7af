#pragma once

#include <optional>
#include <string_view>

namespace macrotask {

// How the members of a barrier learn that all have arrived. One file each:
// counting_barrier.cc, dissemination_barrier.cc, tree_barrier.cc.
enum class BarrierAlgorithm {
  kAuto,           // what ChooseBarrierAlgorithm() says, where it may choose
  kCounter,        // all count on one line, which is the release as well
  kDissemination,  // everybody tells the one 1, 2, 4, ... further on
  kTree,           // everybody tells its parent, and the root tells all
};

// Returns "auto", "counter", "dissemination" or "tree".
std::string_view Name(BarrierAlgorithm algorithm);

// Returns the algorithm that Name() calls `name`, or nothing if there is none.
std::optional<BarrierAlgorithm> ParseBarrierAlgorithm(std::string_view name);

// Returns the fastest algorithm, never kAuto, for `num_tasks` members with a
// processor each.
BarrierAlgorithm ChooseBarrierAlgorithm(int num_tasks);

}  // namespace macrotask
