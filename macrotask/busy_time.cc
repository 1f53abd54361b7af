#include "macrotask/busy_time.h"

#include <sched.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>

#include "macrotask/mutex.h"
#include "macrotask/placement.h"

namespace macrotask {
namespace {

using Clock = std::chrono::steady_clock;

// Of the whole process; never destroyed, as tasks may outlive static objects.
struct Account {
  Mutex mutex;  // guards all below
  int num_busy = 0;
  Clock::time_point since = Clock::now();
  std::array<Clock::duration, CPU_SETSIZE + 1> times{};  // by num_busy, or more

  // Adds the time that has passed since the last change.
  void Settle() {
    const Clock::time_point now = Clock::now();
    times[static_cast<std::size_t>(std::clamp(num_busy, 0, CPU_SETSIZE))] +=
        now - since;
    since = now;
  }
};

Account& TheAccount() {
  static Account* const account = new Account;
  return *account;
}

}  // namespace

std::vector<double> BusyTimes() {
  Account& account = TheAccount();
  const auto most = static_cast<std::size_t>(NumProcessors());
  std::vector<double> seconds(most + 1, 0.0);
  const MutexGuard guard(account.mutex);
  account.Settle();
  for (std::size_t busy = 0; busy < account.times.size(); ++busy) {
    seconds[std::min(busy, most)] +=
        std::chrono::duration<double>(account.times[busy]).count();
  }
  return seconds;
}

std::string ToString(const std::vector<double>& busy_times) {
  double total = 0, weighted = 0;
  for (std::size_t busy = 0; busy < busy_times.size(); ++busy) {
    total += busy_times[busy];
    weighted += static_cast<double>(busy) * busy_times[busy];
  }
  std::string text = "  processors busy     seconds   share\n";
  char line[96];
  for (std::size_t busy = 0; busy < busy_times.size(); ++busy) {
    std::snprintf(line, sizeof line, "%17zu %11.6f %6.1f %%\n", busy,
                  busy_times[busy],
                  total > 0 ? 100 * busy_times[busy] / total : 0.0);
    text += line;
  }
  std::snprintf(line, sizeof line,
                "  total %21.6f\n  average concurrency %.2f\n", total,
                total > 0 ? weighted / total : 0.0);
  return text + line;
}

void NoteBusy(int change) {
  Account& account = TheAccount();
  const MutexGuard guard(account.mutex);
  account.Settle();
  account.num_busy += change;
}

}  // namespace macrotask
