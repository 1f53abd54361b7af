#include "bench/predict/measured_run.h"

#include "macrotask/placement.h"

namespace bench::predict {

MeasuredRun::MeasuredRun(const RunCase& run_case, const LiftCase& lift,
                         macrotask::WaitPolicy wait, double delay_rate)
    : lift_(lift),
      system_(lift.lift().model, lift.torques(),
              static_cast<dynamics::Lanes>(run_case.num_lanes)),
      with_work_(system_,
                 {.work = DelaySteps(run_case.work * 1e6, delay_rate)}),
      integration_(with_work_, {.method = run_case.figure.method,
                                .step = lift.step(),
                                .num_steps = lift.num_steps(),
                                .figure = run_case.figure.figure,
                                .partition = run_case.figure.partition,
                                .wait = wait}) {}

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
