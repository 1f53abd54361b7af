#include "bench/costs.h"

#include <array>
#include <chrono>
#include <functional>
#include <memory>
#include <utility>

#include "bench/one_point.h"
#include "bench/ping_pong.h"
#include "macrotask/barrier.h"
#include "macrotask/deadlock.h"
#include "macrotask/lock.h"
#include "macrotask/placement.h"
#include "macrotask/task.h"
#include "macrotask/trace.h"

namespace bench {
namespace {

using Clock = std::chrono::steady_clock;

double SecondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// Seconds for one of `calls` calls in a loop.
double TimeLoop(int calls, const std::function<void(int)>& loop) {
  const Clock::time_point start = Clock::now();
  loop(calls);
  return SecondsSince(start) / calls;
}

struct Measured {
  Cost cost;
  int calls;
  std::function<void(int)> loop;
};

// Runs all loops in turn, again and again; the first time is dropped.
std::vector<Cost> Interleave(std::vector<Measured> measured, int repetitions) {
  for (int r = 0; r <= repetitions; ++r) {
    for (Measured& m : measured) {
      const double seconds = TimeLoop(m.calls, m.loop);
      if (r > 0) m.cost.seconds.push_back(seconds);
    }
  }
  std::vector<Cost> costs;
  for (Measured& m : measured) costs.push_back(std::move(m.cost));
  return costs;
}

template <typename Function>
std::function<void(int)> Repeat(Function function) {
  return [function](int calls) {
    for (int call = 0; call < calls; ++call) function();
  };
}

// Two tasks evaluate at once, each for itself: what the two processors give
// when nobody waits for anybody, hence the most that two tasks can gain.
Measured TwoAtOnce(const LiftCase& lift, dynamics::Lanes lanes,
                   const std::string& with) {
  using Points = std::array<std::unique_ptr<OnePoint>, 2>;
  const auto points = std::make_shared<Points>();
  macrotask::RunTasks(2, [&](int task) {
    (*points)[static_cast<std::size_t>(task)] =
        std::make_unique<OnePoint>(lift, lanes);
  });
  // So many that starting the tasks does not count.
  constexpr int kCalls = 2000;
  return {{"evaluation, two at once", with, {}}, kCalls, [points](int calls) {
            macrotask::RunTasks(2, [&](int task) {
              OnePoint& point = *(*points)[static_cast<std::size_t>(task)];
              for (int call = 0; call < calls; ++call) point.Evaluate();
            });
          }};
}

}  // namespace

std::vector<Cost> MeasureBlocks(const LiftCase& lift, int repetitions) {
  std::vector<Measured> measured;
  for (const auto lanes : {dynamics::Lanes::kFour, dynamics::Lanes::kOne}) {
    const auto point = std::make_shared<OnePoint>(lift, lanes);
    const std::string with =
        lanes == dynamics::Lanes::kOne ? "1 lane" : "4 lanes";
    constexpr int kCalls = 1000;
    measured.push_back(
        {{"OCD", with, {}}, kCalls, Repeat([point] { point->Ocd(); })});
    measured.push_back(
        {{"RMA", with, {}}, kCalls, Repeat([point] { point->Rma(); })});
    measured.push_back(
        {{"CCD", with, {}}, kCalls, Repeat([point] { point->Ccd(); })});
    measured.push_back({{"evaluation", with, {}}, kCalls, Repeat([point] {
                          point->Evaluate();
                        })});
    if (macrotask::NumProcessors() >= 2) {
      measured.push_back(TwoAtOnce(lift, lanes, with));
    }
  }
  return Interleave(std::move(measured), repetitions);
}

std::vector<Cost> MeasureSynchronization(macrotask::WaitPolicy wait,
                                         int repetitions) {
  using macrotask::RunTasks;
  std::vector<Measured> measured;
  const std::string policy(Name(wait.kind));
  const auto lock = std::make_shared<macrotask::Lock>(wait);
  measured.push_back(
      {{"LOCKON + LOCKOFF", "1 task, " + policy, {}}, 10000, Repeat([lock] {
         lock->On();
         lock->Off();
       })});
  const auto taken = std::make_shared<macrotask::Lock>(wait);
  taken->On();
  measured.push_back({{"LOCKTEST", "1 task, set, " + policy, {}},
                      10000,
                      Repeat([taken] { (void)taken->Test(); })});
  measured.push_back(
      {{"TSKSTART + TSKWAIT", "1 task, " + policy, {}}, 100, Repeat([wait] {
         macrotask::Task task([] {}, {.wait = wait});
         task.Wait();
       })});
  if (macrotask::NumProcessors() >= 2) {
    // So many that starting the tasks does not count.
    const int calls = wait.kind == macrotask::WaitKind::kBlock ? 300 : 100'000;
    const auto barsync = [wait](int n) {
      macrotask::Barrier barrier(2, wait);
      RunTasks(
          2,
          [&](int) {
            for (int call = 0; call < n; ++call) barrier.Sync();
          },
          wait);
    };
    measured.push_back({{"BARSYNC", "2 tasks, " + policy, {}}, calls, barsync});
    measured.push_back(
        {{"BARSYNC, no deadlock detection", "2 tasks, " + policy, {}},
         calls,
         [barsync](int n) {
           macrotask::SetDeadlockDetection(false);
           barsync(n);
           macrotask::SetDeadlockDetection(true);
         }});
    measured.push_back({{"BARSYNC, traced", "2 tasks, " + policy, {}},
                        calls,
                        [barsync](int n) {
                          macrotask::SetTraceClasses(
                              macrotask::kAllTraceClasses);
                          barsync(n);
                          macrotask::SetTraceClasses(0);
                        }});
    measured.push_back({{"EVPOST to EVWAIT", "2 tasks, " + policy, {}},
                        calls,
                        [wait](int n) { PingPong(wait, n); }});
  }
  return Interleave(std::move(measured), repetitions);
}

}  // namespace bench
