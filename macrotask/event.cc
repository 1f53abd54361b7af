#include "macrotask/event.h"

#include <cstdint>

#include "macrotask/logical_wait.h"

namespace macrotask {
namespace {

bool IsPosted(std::uint64_t epoch) { return epoch % 2 == 1; }

}  // namespace

void Event::Wait() {
  RecordAround(TraceClass::kEvents, TraceAction::kEventWait,
               TraceAction::kEventWaitEnd, TraceData(number()), [this] {
                 // To wait for the epoch to pass, rather than for the event to
                 // be posted, is what makes Post() and Clear() in a row release
                 // a task that looked at neither in between.
                 const std::uint64_t seen = epoch_.Read();
                 if (IsPosted(seen)) return;
                 epoch_.AwaitPast(seen, policy_, waited_);
               });
}

bool Event::Test() const {
  const bool posted = IsPosted(epoch_.Read());
  RecordIf(TraceClass::kEvents,
           posted ? TraceAction::kEventTest : TraceAction::kEventTestClear,
           TraceData(number(), 1));
  if (!posted && processor_of_caller != nullptr) GiveWay();
  return posted;
}

}  // namespace macrotask
