#pragma once

#include <chrono>
#include <map>
#include <vector>

#include "bench/predict/machine.h"
#include "bench/sync_rows.h"
#include "bench/sync_samples.h"
#include "macrotask/wait_policy.h"

// What waiting costs on this machine, by the laboratory (macrotask sync).

namespace bench::predict {

// Rows of the laboratory, for two tasks and for more than there are processors.
class WaitSampler {
 public:
  explicit WaitSampler(std::chrono::nanoseconds hold_time);

  // Samples everything so many times.
  void Round(int repetitions);

  const std::vector<SyncSeries>& series() const { return series_; }
  std::vector<double> round_trips() const;

 private:
  std::vector<Variant> variants_;
  std::vector<SyncSeries> series_;  // by variant
};

// The costs of every way to wait at one distance of the processors, out of the
// rows:
//
//   barrier.two, event   overhead of BARSYNC, of EVPOST to EVWAIT, 2 tasks
//   barrier.further      half a round trip, `line`
//   barrier.round, level overhead of the dissemination and the tree of 2 tasks
//   wake                 overhead of a BARSYNC that always sleeps (block), of
//                        two tasks that come at once: each is woken in turn
//   waker                the same of a task that comes late and wakes the other
//   turn, shared_wake    overhead of BARSYNC over the number of tasks, n, with
//                        more of them than processors, P: n / P turn +
//                        shared_wake
//
// A row that is missing at this distance is taken from the other one.
std::map<macrotask::WaitKind, WaitCost> FitWaits(
    const std::vector<SyncRow>& rows, Distance distance, double line,
    int processors, std::chrono::nanoseconds hold_time);

}  // namespace bench::predict
