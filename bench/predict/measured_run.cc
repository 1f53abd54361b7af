#include "bench/predict/measured_run.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "bench/sync_clock.h"
#include "bench/sync_delay.h"
#include "macrotask/placement.h"
#include "macrotask/task.h"

namespace bench::predict {

MeasuredRun::MeasuredRun(const RunCase& run_case, const LiftCase& lift,
                         macrotask::WaitPolicy wait, long delay_steps)
    : lift_(lift),
      system_(lift.lift().model, lift.torques(),
              static_cast<dynamics::Lanes>(run_case.num_lanes)),
      with_work_(system_, {.work = delay_steps}),
      integration_(with_work_, {.method = run_case.figure.method,
                                .step = lift.step(),
                                .num_steps = lift.num_steps(),
                                .figure = run_case.figure.figure,
                                .partition = run_case.figure.partition,
                                .wait = wait}) {}

void MeetBoth() {
  constexpr long kSteps = 500'000;
  const int tasks = std::min(2, macrotask::NumProcessors());
  macrotask::RunTasks(tasks, [](int) { Delay(kSteps); });
}

double MeasureDelayStep(int num_tasks) {
  constexpr long kSteps = 100'000;
  std::array<double, 2> seconds{};
  MeetBoth();
  macrotask::RunTasks(num_tasks, [&](int task) {
    Delay(kSteps);
    const std::uint64_t start = Ticks();
    Delay(kSteps);
    seconds[static_cast<std::size_t>(task)] =
        SecondsBetween(start, Ticks()) / kSteps;
  });
  return std::max(seconds[0], seconds[1]);
}

double MeasuredRun::Measure() {
  WarmUp([this] { integration_.RunFrom(lift_.Planned()); });
  return integration_.RunFrom(lift_.Planned()).seconds();
}

ProcessorsFor::ProcessorsFor(int processors)
    : before_(macrotask::NumProcessors()) {
  macrotask::SetMaxProcessors(processors);
}

ProcessorsFor::~ProcessorsFor() { macrotask::SetMaxProcessors(before_); }

}  // namespace bench::predict
