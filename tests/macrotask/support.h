#pragma once

#include <gtest/gtest.h>
#include <sched.h>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <ostream>
#include <string>
#include <tuple>
#include <vector>

#include "macrotask/barrier_algorithm.h"
#include "macrotask/cache_line.h"
#include "macrotask/logical_wait.h"
#include "macrotask/task.h"
#include "macrotask/wait_policy.h"

namespace macrotask {

inline const WaitPolicy kAllPolicies[] = {
    WaitPolicy::Block(), WaitPolicy::Spin(), WaitPolicy::Hold(),
    WaitPolicy::Logical()};
inline constexpr BarrierAlgorithm kAllBarrierAlgorithms[] = {
    BarrierAlgorithm::kAuto, BarrierAlgorithm::kCounter,
    BarrierAlgorithm::kDissemination, BarrierAlgorithm::kTree};
inline constexpr int kTaskCounts[] = {1, 2, 3, 4, 7, 16};

// How a failing test shows its parameter.
inline void PrintTo(const WaitPolicy& policy, std::ostream* out) {
  *out << Name(policy.kind);
}

// The policy for tasks that have a pthread each, whatever that of the objects.
inline WaitPolicy OnPthreads(const WaitPolicy& policy) {
  return policy.kind == WaitKind::kLogical ? WaitPolicy::Hold() : policy;
}

// A suite for every policy, and one for every policy and number of tasks.
class ByPolicy : public testing::TestWithParam<WaitPolicy> {};

class ByPolicyAndTasks
    : public testing::TestWithParam<std::tuple<WaitPolicy, int>> {
 protected:
  WaitPolicy policy() const { return std::get<0>(GetParam()); }
  int num_tasks() const { return std::get<1>(GetParam()); }
  // As many as are quick even if 16 tasks share one processor.
  int num_rounds() const {
    return num_tasks() <= 2 ? 2000 : 1600 / num_tasks();
  }
};

inline std::string PolicyName(const testing::TestParamInfo<WaitPolicy>& info) {
  return std::string(Name(info.param.kind));
}

inline std::string PolicyAndTasksName(
    const testing::TestParamInfo<std::tuple<WaitPolicy, int>>& info) {
  return std::string(Name(std::get<0>(info.param).kind)) +
         std::to_string(std::get<1>(info.param));
}

#define INSTANTIATE_BY_POLICY(suite)                                         \
  INSTANTIATE_TEST_SUITE_P(Policies, suite, testing::ValuesIn(kAllPolicies), \
                           PolicyName)
#define INSTANTIATE_BY_POLICY_AND_TASKS(suite)                               \
  INSTANTIATE_TEST_SUITE_P(Policies, suite,                                  \
                           testing::Combine(testing::ValuesIn(kAllPolicies), \
                                            testing::ValuesIn(kTaskCounts)), \
                           PolicyAndTasksName)

// Lets others run until `condition()`; ends at the time-out of the test if that
// never comes.
template <typename Condition>
void YieldUntil(const Condition& condition) {
  while (!condition()) {
    sched_yield();
    if (processor_of_caller != nullptr) GiveWay();
  }
}

// Runs `num_tasks` tasks through `num_phases` phases, separated by sync(task).
// Returns how often a task saw another one in a phase that is not its own: one
// behind if the barrier opened early, one ahead if a task came round too soon.
// The slots are atomic, so that a broken barrier is a wrong number and no race.
template <typename Sync>
int CountPhaseErrors(int num_tasks, int num_phases, const Sync& sync,
                     WaitPolicy wait = WaitPolicy::Hold()) {
  std::vector<CacheAligned<std::atomic<int>>> phase_of(
      static_cast<std::size_t>(num_tasks));
  std::atomic<int> num_errors = 0;
  RunTasks(
      num_tasks,
      [&](int task) {
        for (int phase = 1; phase <= num_phases; ++phase) {
          phase_of[static_cast<std::size_t>(task)]->store(
              phase, std::memory_order_relaxed);
          sync(task);
          for (const auto& other : phase_of) {
            if (other->load(std::memory_order_relaxed) != phase) ++num_errors;
          }
          sync(task);
        }
      },
      wait);
  return num_errors;
}

// What `num_tasks` tasks have in their slots after `num_rounds` rounds, in each
// of which each of them computes a new value from all slots: one stale slot in
// any round changes every later one. sync(task) comes after the reading and
// after the writing. The slots are not atomic.
template <typename Sync>
std::vector<std::uint64_t> MixSlots(int num_tasks, int num_rounds,
                                    const Sync& sync, WaitPolicy wait) {
  const auto n = static_cast<std::size_t>(num_tasks);
  std::vector<std::uint64_t> old_slots(n, 1);
  std::vector<std::uint64_t> new_slots(n, 0);
  RunTasks(
      num_tasks,
      [&](int task) {
        const auto own = static_cast<std::size_t>(task);
        for (int round = 0; round < num_rounds; ++round) {
          std::uint64_t sum = own;
          for (std::uint64_t slot : old_slots) sum = 3 * sum + slot;
          new_slots[own] = sum;
          sync(task);
          old_slots[own] = new_slots[own];
          sync(task);
        }
      },
      wait);
  return old_slots;
}

// The same by one task alone.
inline std::vector<std::uint64_t> MixedSlots(int num_tasks, int num_rounds) {
  std::vector<std::uint64_t> slots(static_cast<std::size_t>(num_tasks), 1);
  for (int round = 0; round < num_rounds; ++round) {
    std::vector<std::uint64_t> next(slots.size());
    for (std::size_t task = 0; task < next.size(); ++task) {
      next[task] = task;
      for (std::uint64_t slot : slots) next[task] = 3 * next[task] + slot;
    }
    slots = next;
  }
  return slots;
}

}  // namespace macrotask
