#include "bench/sync_hold_time.h"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <stdexcept>

#include "bench/ping_pong.h"
#include "macrotask/placement.h"
#include "macrotask/wait_policy.h"

namespace bench {
namespace {

using macrotask::WaitPolicy;

// Long enough for the start of the tasks not to count, short enough for the two
// kinds to be neighbours in time: about 10 ms and 0.2 ms.
constexpr int kHandOversAsleep = 400;
constexpr int kHandOversSpinning = 4000;

double TimeHandOver(WaitPolicy wait, int num_hand_overs) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point start = Clock::now();
  PingPong(wait, num_hand_overs);
  return std::chrono::duration<double>(Clock::now() - start).count() /
         num_hand_overs;
}

}  // namespace

HoldTime CalcHoldTime(const HandOverSamples& samples) {
  constexpr double kMicrosecond = 1e-6;
  std::vector<double> costs;
  for (std::size_t i = 0; i < samples.asleep.size(); ++i) {
    const double cost = samples.asleep[i] - samples.spinning[i];
    if (cost > 0) costs.push_back(cost);
  }
  if (costs.empty()) {
    throw std::runtime_error(
        "sleeping was never slower than spinning here: expected a machine with "
        "a processor for each of 2 tasks");
  }
  const Summary cost = Summarize(costs);
  return {
      .cost = cost,
      .recommended = std::ceil(2 * cost.median / kMicrosecond) * kMicrosecond,
      .dropped = static_cast<int>(samples.asleep.size() - costs.size())};
}

HandOverSamples MeasureHandOvers(int repetitions,
                                 const std::function<void(int, int)>& show) {
  if (macrotask::NumProcessors() < 2) {
    throw std::invalid_argument(
        "--calibrate needs 2 processors: this process may use 1");
  }
  HandOverSamples samples;
  TimeHandOver(WaitPolicy::Block(), kHandOversAsleep);  // warms up
  for (int r = 0; r < repetitions; ++r) {
    show(r, repetitions);
    samples.asleep.push_back(
        TimeHandOver(WaitPolicy::Block(), kHandOversAsleep));
    samples.spinning.push_back(
        TimeHandOver(WaitPolicy::Spin(), kHandOversSpinning));
  }
  return samples;
}

std::string HoldTimeText(const HoldTime& hold_time) {
  const auto us = [](double seconds) { return seconds * 1e6; };
  const auto default_us =
      std::chrono::duration<double, std::micro>(macrotask::kDefaultHoldTime);
  return fmt::format(
      "To fall asleep and be woken adds {:.1f} us [{:.1f}, {:.1f}] to EVPOST "
      "to "
      "EVWAIT\n(2 tasks, block less spin: median, 95 % interval, n = {}{}; p95 "
      "{:.1f} us).\n"
      "\n"
      "A wait should spin for about twice that before it sleeps, {:.0f} us; "
      "the "
      "default\nis {:.0f} us. To set it:\n"
      "\n"
      "    --hold-time {:.0f}                                     this "
      "program\n"
      "    WaitPolicy::Hold(std::chrono::microseconds({:.0f}))    C++\n"
      "    CALL TSKTUNE('HOLDTIME', {:.0f})                       Fortran, C\n",
      us(hold_time.cost.median), us(hold_time.cost.interval.low),
      us(hold_time.cost.interval.high), hold_time.cost.n,
      hold_time.dropped == 0 ? ""
                             : fmt::format(", {} dropped", hold_time.dropped),
      us(hold_time.cost.p95), us(hold_time.recommended), default_us.count(),
      us(hold_time.recommended), us(hold_time.recommended),
      us(hold_time.recommended));
}

}  // namespace bench
