#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "bench/sync_latency.h"
#include "bench/sync_loop.h"

namespace bench {

enum class SyncFamily { kBarrier, kEvent, kLock, kTask, kLimit };

enum class Skew {
  kZero,
  kLate,  // task 0 has kLateMicroseconds more work than the others
};
inline constexpr double kLateMicroseconds = 10;

std::string_view Name(SyncFamily family);
std::string_view Name(Skew skew);

// How a sample of a variant is timed.
enum class Timing {
  kLoop,   // a loop of calls, less the same loop without them
  kWhole,  // call by call: Marks In() to Release() of task 0
};

// A construct, by whom, as so many tasks use it: a row of the tables.
struct Variant {
  SyncFamily family = SyncFamily::kBarrier;
  std::string construct;  // "BARSYNC"
  std::string by;         // "hold", "libgomp"
  int num_tasks = 1;
  double work = 0;  // us between calls
  Skew skew = Skew::kZero;

  LatencyKind latency = LatencyKind::kNone;
  Timing timing = Timing::kLoop;
  // One task after the other, with its work inside (a lock): the figures are of
  // one call of any task. Otherwise of one call of all tasks together.
  bool serial = false;
  int parts = 1;  // of a call for one of which the figures are: 2, one way

  std::string missing = {};  // why it cannot be measured; empty: it can

  // Runs the loop once, on a fresh construct; with marks for latencies if
  // `marks` is not null.
  std::function<LoopTiming(const LoopSpec&, Marks* marks)> run = {};
};

// The `run` of a variant whose construct `make()` returns by unique_ptr; or
// `make(work)`, of a construct that does the work itself, inside.
template <typename Make>
std::function<LoopTiming(const LoopSpec&, Marks*)> RunOn(Team team, Make make) {
  return [team = std::move(team), make](LoopSpec spec, Marks* marks) {
    const auto op = [&] {
      if constexpr (std::is_invocable_v<Make, long>) {
        return make(std::exchange(spec.work, 0));
      } else {
        return make();
      }
    }();
    if (marks != nullptr) return RunLoop(*op, team, spec, *marks);
    NoMarks none;
    return RunLoop(*op, team, spec, none);
  };
}

}  // namespace bench
