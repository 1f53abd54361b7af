// TreeBarrier, macrotask/tree_barrier.cc: NUM_TASKS members go through
// NUM_PHASES phases. Its flags are what epoch.pml proves of Epoch: numbers for
// which one may wait, and sleep, until they are past what one has seen. FAN_IN
// is 2 for more levels with few members. ANONYMOUS=1: every other phase is one
// of Sync() without a member, on what counting_barrier.pml proves of
// CountingBarrier.
//
// Proved: nobody leaves phase k before all have arrived in it (assertion);
// nobody waits for ever (no state in which all that remain are blocked); no
// flag is ahead of who waits for it, and Epoch is asked for nothing that it
// does not promise (assertions).
//
// proves NUM_TASKS=2 NUM_PHASES=6 FAN_IN=2
// proves NUM_TASKS=3 NUM_PHASES=4 FAN_IN=2
// proves NUM_TASKS=4 NUM_PHASES=4 FAN_IN=2
// proves NUM_TASKS=6 NUM_PHASES=2 FAN_IN=2
// proves NUM_TASKS=6 NUM_PHASES=2 FAN_IN=4
// proves NUM_TASKS=4 NUM_PHASES=4 FAN_IN=2 ANONYMOUS=1
// finds BUG=TELL_FIRST NUM_TASKS=4 NUM_PHASES=1 FAN_IN=2
// finds BUG=RELEASE_FIRST NUM_TASKS=3 NUM_PHASES=1 FAN_IN=2
// finds BUG=CHILD_FORGOTTEN NUM_TASKS=3 NUM_PHASES=1 FAN_IN=2
// finds BUG=ONE_RELEASE NUM_TASKS=2 NUM_PHASES=2 FAN_IN=2
// finds BUG=NOT_RESET NUM_TASKS=2 NUM_PHASES=2 FAN_IN=2
// finds BUG=NO_ROOT NUM_TASKS=2 NUM_PHASES=1 FAN_IN=2
//
// A comment "source: text" says which text of macrotask/source the line models.

#define TELL_FIRST 1       // a member tells its parent, then awaits its children
#define RELEASE_FIRST 2    // the root releases, then awaits its children
#define CHILD_FORGOTTEN 3  // the last one
#define ONE_RELEASE 4      // a release that is good for all phases
#define NOT_RESET 5        // so is what a child tells
#define NO_ROOT 6          // the root waits to be released like all others

byte complete[NUM_TASKS];
byte released;
byte arrivals;  // of CountingBarrier

byte phase_of[NUM_TASKS];  // in which a task has arrived, from 1; no part of it

#if BUG == NOT_RESET
#define TOLD(child) (complete[child] > 0)
#else
// tree_barrier.cc: nodes_[static_cast<std::size_t>(child)].complete.AwaitPast(
//     phase - 1, policy_, waited_);
#define TOLD(child) (complete[child] > phase - 1)
#endif

#if BUG == ONE_RELEASE
#define RELEASED (released > 0)
#else
// tree_barrier.cc: released_.AwaitPast(phase - 1, policy_, waited_);
#define RELEASED (released > phase - 1)
#endif

inline AwaitChildren() {
  // tree_barrier.cc: const int first = kFanIn * member + 1;
  child = FAN_IN * member + 1;
  // tree_barrier.cc: const int end = std::min(first + kFanIn, num_tasks_);
  end = child + FAN_IN;
  end = (end < NUM_TASKS -> end : NUM_TASKS);
#if BUG == CHILD_FORGOTTEN
  end--;
#endif
  do
  // tree_barrier.cc: for (int child = first; child < end; ++child) {
  :: child < end ->
#ifndef BUG
     assert(complete[child] == phase - 1 || complete[child] == phase);
#endif
     TOLD(child);
     child++
  :: else -> break
  od;
  child = 0; end = 0
}

inline SyncMember() {
  // tree_barrier.cc: node.arrived.store(phase, std::memory_order_relaxed);
  atomic { phase++; phase_of[member]++ }
#if BUG != TELL_FIRST && BUG != RELEASE_FIRST
  AwaitChildren();  // tree_barrier.cc: AwaitChildren(member, phase);
#endif
#if BUG != NO_ROOT
  if
  :: member == 0 ->
     // tree_barrier.cc: if (member == 0) return released_.AdvanceTo(phase);
     released = phase;
#if BUG == TELL_FIRST || BUG == RELEASE_FIRST
     AwaitChildren()
#endif
  :: else ->
#endif
#if BUG == RELEASE_FIRST
     AwaitChildren();
#endif
     complete[member] = phase;  // tree_barrier.cc: complete.AdvanceTo(phase);
#if BUG == TELL_FIRST
     AwaitChildren();
#endif
#ifndef BUG
     assert(released == phase - 1 || released == phase);
#endif
     RELEASED
#if BUG != NO_ROOT
  fi
#endif
}

inline SyncAnonymous() {
  atomic {
    end_of_phase = (arrivals / NUM_TASKS + 1) * NUM_TASKS;
    arrivals++;
    phase_of[member]++
  }
  arrivals >= end_of_phase
}

active [NUM_TASKS] proctype Task() {
  byte member = _pid;
  byte phase, child, end, end_of_phase, all, other;
  do
  :: all < NUM_PHASES ->
#if ANONYMOUS
     if
     :: all % 2 == 1 -> SyncAnonymous()
     :: else -> SyncMember()
     fi;
#else
     SyncMember();
#endif
     atomic {
       all++;
       other = 0;
       do
       :: other < NUM_TASKS ->
          assert(phase_of[other] == all || phase_of[other] == all + 1);
          other++
       :: else -> break
       od;
       other = 0; end_of_phase = 0
     }
  :: else -> break
  od
}
