#pragma once

#include <cstdint>

#include "macrotask/epoch.h"
#include "macrotask/trace_point.h"
#include "macrotask/wait_policy.h"
#include "macrotask/waited_object.h"

namespace macrotask {

// Something that has happened, or not yet. A posted event stays posted until it
// is cleared, however many tasks wait for it.
//
// Cray name: EVPOST, EVWAIT, EVCLEAR, EVTEST, on an event assigned by EVASGN.
// Use: any task may call anything, in any number. A Post() followed at once by
// a Clear() still releases every task that was waiting. The event must outlive
// the last return from any of its functions.
// Memory ordering: what a task wrote before its Post() is visible to every task
// whose Wait() it lets return, and to one whose Test() it makes true. A Clear()
// sees what was written before the posts that it clears, so that `Clear();
// look; Wait()` misses nothing.
// Cost: one atomic read-modify-write for Post() and Clear(), one load for
// Wait() on a posted event (bench row "EVPOST to EVWAIT").
//
//   Event ready;
//   RunTasks(2, [&](int task) {
//     if (task == 0) { table = Fill(); ready.Post(); }
//     if (task == 1) { ready.Wait(); Use(table); } });
class Event {
 public:
  // Makes a cleared event on which tasks wait as `policy` says.
  explicit Event(WaitPolicy policy = {}) : policy_(policy) {}

  // Posts the event and wakes every task that waits. Harmless twice.
  void Post() {
    RecordIf(TraceClass::kEvents, TraceAction::kEventPost, TraceData(number()));
    epoch_.AdvanceIfEven();
  }

  // Returns when the event is posted, at once if it is. Never clears it.
  void Wait();

  // Clears the event. Harmless twice. Tasks that a post has released stay
  // released.
  void Clear() {
    RecordIf(TraceClass::kEvents, TraceAction::kEventClear,
             TraceData(number()));
    epoch_.AdvanceIfOdd();
  }

  // True iff the event is posted.
  bool Test() const;

  const WaitPolicy& policy() const { return policy_; }

  // Of this event in lists and traces: 1, 2, ... in order of construction.
  std::uint32_t number() const { return waited_.number; }

 private:
  Epoch epoch_;  // even: cleared, odd: posted
  const WaitPolicy policy_;
  const WaitedObject waited_{ObjectKind::kEvent,
                             NextNumber(ObjectKind::kEvent)};
};

}  // namespace macrotask
