#pragma once

#include <pthread.h>

#include <atomic>
#include <cstdint>
#include <memory>
#include <variant>

#include "macrotask/barrier_algorithm.h"
#include "macrotask/counting_barrier.h"
#include "macrotask/dissemination_barrier.h"
#include "macrotask/tree_barrier.h"
#include "macrotask/two_level_barrier.h"
#include "macrotask/wait_policy.h"
#include "macrotask/waited_object.h"

namespace macrotask {

class LogicalBarrier;
class UndecidedBarrier;

// Internal: pthread_barrier_t with its errors checked, for WaitPolicy::Block().
class BlockingBarrier {
 public:
  BlockingBarrier(int num_tasks, std::uint32_t number);
  ~BlockingBarrier();
  BlockingBarrier(const BlockingBarrier&) = delete;
  BlockingBarrier& operator=(const BlockingBarrier&) = delete;

  void Sync();

  // Number of tasks that have arrived and whose phase is not complete.
  int num_waiting() const;

 private:
  const std::uint64_t num_tasks_;
  const WaitedObject waited_;
  pthread_barrier_t barrier_;
  // Arrivals since the beginning, for those who look from outside: the
  // pthread_barrier_t does not say whether a wait is over.
  std::atomic<std::uint64_t> arrivals_{0};
};

// Holds every task that calls Sync() until `num_tasks` tasks have called it,
// then releases them all and is at once ready for the next phase.
//
// Cray name: BARSYNC, on a barrier assigned by BARASGN.
// Use: exactly `num_tasks` tasks call Sync(), once per phase each. A task that
// knows which of them it is says so by Sync(member): where many tasks have a
// processor each, that is faster. In one phase either all say it or none; the
// next phase may differ, and have other tasks as the members. The barrier must
// outlive the last return from Sync(). A barrier of 1 holds nobody.
// Memory ordering: what any task wrote before its k-th Sync() is visible to
// every task after its own k-th Sync() returns.
// Cost: one atomic increment per task and one line that all waiters read; with
// more tasks than processors the tasks of one processor meet first, and all but
// one of them sleep. Under WaitPolicy::Block() a pthread_barrier_t, under
// WaitPolicy::Logical() one line a processor (bench row "BARSYNC").
// Sync(member) costs the same for few tasks, and where they wait for processors;
// else about 2 log2 num_tasks transfers of a cache line in place of num_tasks
// (bench rows "BARSYNC, dissemination" and "BARSYNC, tree").
//
//   Barrier barrier(num_tasks);
//   RunTasks(num_tasks, [&](int task) {
//     for (int step = 0; step < num_steps; ++step) {
//       Advance(task); barrier.Sync(task); } });
class Barrier {
 public:
  // Makes a barrier of `num_tasks` tasks that wait as `policy` says. Throws
  // std::invalid_argument if `num_tasks` < 1.
  //
  // `algorithm` is for those who compare: any but kAuto is what Sync(member)
  // does, whatever the policy and however many the tasks; kCounter is what
  // Sync() does as well.
  explicit Barrier(int num_tasks, WaitPolicy policy = {},
                   BarrierAlgorithm algorithm = BarrierAlgorithm::kAuto);
  ~Barrier();
  Barrier(const Barrier&) = delete;
  Barrier& operator=(const Barrier&) = delete;

  // Returns when `num_tasks()` tasks have called it in this phase.
  void Sync();

  // The same, by a task that is the `member`-th of them, 0 .. num_tasks() - 1:
  // each member once a phase. Throws std::out_of_range if there is none such.
  void Sync(int member);

  int num_tasks() const { return num_tasks_; }

  // Number of tasks that are in Sync() now and wait for others.
  int num_waiting() const;

  const WaitPolicy& policy() const { return policy_; }

  // Of this barrier in lists and traces: 1, 2, ... in order of construction.
  std::uint32_t number() const { return number_; }

 private:
  // One alternative per algorithm, one file per alternative; the constructor
  // chooses, by policy and number of tasks. Of Sync():
  using Algorithm =
      std::variant<std::monostate, BlockingBarrier, CountingBarrier,
                   TwoLevelBarrier, std::unique_ptr<LogicalBarrier>,
                   std::unique_ptr<UndecidedBarrier>>;
  // Of Sync(member); none: that of Sync().
  using MemberAlgorithm =
      std::variant<std::monostate, DisseminationBarrier, TreeBarrier>;

  void ChooseAlgorithm(BarrierAlgorithm algorithm);
  void ChooseMemberAlgorithm(BarrierAlgorithm algorithm);
  void CheckMember(int member) const;
  void SyncUntraced();
  void SyncUntraced(int member);

  const int num_tasks_;
  const WaitPolicy policy_;
  const std::uint32_t number_;
  Algorithm algorithm_;
  MemberAlgorithm member_algorithm_;
};

}  // namespace macrotask
