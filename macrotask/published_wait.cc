#include "macrotask/published_wait.h"

#include "macrotask/busy_time.h"
#include "macrotask/deadlock.h"
#include "macrotask/processor_load.h"
#include "macrotask/trace_point.h"

namespace macrotask {

void PublishedWait::Look() const {
  if (record_ != nullptr) DetectDeadlock();
}

void PublishedWait::BeginSleep() const {
  NoteBusy(-1);
  if (load_of_own_processor != nullptr) load_of_own_processor->Add(-1);
  if (record_ == nullptr) return;
  RecordIf(TraceClass::kCpus, TraceAction::kSleep, 0);
  DetectDeadlock();
}

void PublishedWait::EndSleep() const {
  NoteBusy(+1);
  if (load_of_own_processor != nullptr) load_of_own_processor->Add(+1);
  if (record_ == nullptr) return;
  RecordIf(TraceClass::kCpus, TraceAction::kWake, 0);
}

}  // namespace macrotask
