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

  // Samples one of so many rows, 0 ..., once.
  int num_rows() const { return static_cast<int>(series_.size()); }
  void Sample(int row);

  const std::vector<SyncSeries>& series() const { return series_; }
  std::vector<double> round_trips() const;

 private:
  std::vector<SyncSeries> series_;
};

// The costs of every way to wait at one distance of the processors, out of the
// rows:
//
//   barrier.two, event     overhead of BARSYNC, of EVPOST to EVWAIT, 2 tasks
//   barrier.further, post  half a round trip, `one_way`
//   barrier.round, level   overhead of dissemination and of the tree of 2 tasks
//   wake                   overhead of a BARSYNC that always sleeps (block), of
//                          two tasks that come at once: each is woken in turn
//   waker                  overhead of "futex wake to running"
//   turn, shared_wake      overhead of BARSYNC over the number of tasks, n, with
//                          more of them than processors, P: n / P turn +
//                          shared_wake
//
// While nobody sleeps, hold and spin do the same: their rows count as one.
// A row that is missing at this distance is taken from the other one.
std::map<macrotask::WaitKind, WaitCost> FitWaits(
    const std::vector<SyncRow>& rows, Distance distance, double one_way,
    int processors, std::chrono::nanoseconds hold_time);

}  // namespace bench::predict
