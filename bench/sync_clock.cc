#include "bench/sync_clock.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <limits>

#include "macrotask/cache_line.h"
#include "macrotask/spin_then_sleep.h"
#include "macrotask/task.h"

namespace bench {
namespace {

double MeasureTicksPerSecond() {
  using Clock = std::chrono::steady_clock;
  constexpr auto kTime = std::chrono::milliseconds(20);
  const Clock::time_point start = Clock::now();
  const std::uint64_t first = Ticks();
  while (Clock::now() - start < kTime) macrotask::Pause();
  const std::uint64_t last = Ticks();
  const std::chrono::duration<double> seconds = Clock::now() - start;
  return static_cast<double>(last - first) / seconds.count();
}

using Mailbox = macrotask::CacheAligned<std::atomic<std::uint64_t>>;

// Empties the box, whose content is never 0.
std::uint64_t Receive(Mailbox& box) {
  for (;;) {
    // Pairs with the release in Send().
    const std::uint64_t sent = box->load(std::memory_order_acquire);
    if (sent != 0) {
      box->store(0, std::memory_order_relaxed);
      return sent;
    }
    macrotask::Pause();
  }
}

void Send(Mailbox& box) { box->store(Ticks(), std::memory_order_release); }

// The shortest way of a message to the caller, in ticks.
std::int64_t Shortest(std::int64_t so_far, Mailbox& box) {
  const std::uint64_t sent = Receive(box);
  return std::min(so_far, static_cast<std::int64_t>(Ticks() - sent));
}

}  // namespace

double TicksPerSecond() {
  static const double ticks = MeasureTicksPerSecond();
  return ticks;
}

ClockAgreement CompareClocks() {
  constexpr int kMessages = 10'000;
  constexpr auto kNever = std::numeric_limits<std::int64_t>::max();
  Mailbox to_first, to_second;
  std::int64_t there = kNever, back = kNever;
  macrotask::RunTasks(
      2,
      [&](int task) {
        for (int i = 0; i < kMessages; ++i) {
          if (task == 0) {
            Send(to_second);
            back = Shortest(back, to_first);
          } else {
            there = Shortest(there, to_second);
            Send(to_first);
          }
        }
      },
      macrotask::WaitPolicy::Spin());
  return {TicksToSeconds(there), TicksToSeconds(back)};
}

}  // namespace bench
