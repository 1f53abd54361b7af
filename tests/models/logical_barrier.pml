// LogicalBarrier, macrotask/logical_barrier.cc: NUM_TASKS tasks go through
// NUM_PHASES phases, each TASKS_PER_PROCESSOR on a processor of their own, by
// turns, and the last NUM_PTHREADS as pthreads. With PLACES=ANY a task that has
// left a phase goes on with any of the NUM_PROCESSORS: every way in which
// a set of tasks may give its slot to the next, and more.
//
// A processor gives turns in any order, and publishes at any moment between two
// turns, at the latest when it can do nothing else: when it foresees that, or
// every task had a turn, is a question of speed.
//
// Proved: nobody leaves phase k before all have arrived in it (assertion), and
// nobody waits for ever (no state in which all that remain are blocked).
//
// proves NUM_TASKS=2 TASKS_PER_PROCESSOR=1 NUM_PHASES=4
// proves NUM_TASKS=3 TASKS_PER_PROCESSOR=1 NUM_PHASES=3 MAX_EARLY_LOOKS=1
// proves NUM_TASKS=4 TASKS_PER_PROCESSOR=2 NUM_PHASES=3
// proves NUM_TASKS=3 TASKS_PER_PROCESSOR=2 NUM_PTHREADS=1 NUM_PHASES=3
// proves NUM_TASKS=3 TASKS_PER_PROCESSOR=1 NUM_PTHREADS=1 NUM_PHASES=2
// proves NUM_TASKS=3 TASKS_PER_PROCESSOR=1 NUM_PTHREADS=2 NUM_PHASES=2
// proves NUM_TASKS=3 PLACES=ANY NUM_PROCESSORS=2 NUM_PHASES=3 MAX_EARLY_LOOKS=0
// proves NUM_TASKS=3 PLACES=ANY NUM_PROCESSORS=2 NUM_PHASES=2 MAX_EARLY_LOOKS=1
// finds BUG=SET NUM_TASKS=2 TASKS_PER_PROCESSOR=1 NUM_PHASES=2
// finds BUG=PUBLISH_TWICE NUM_TASKS=4 TASKS_PER_PROCESSOR=2 NUM_PHASES=2
// finds BUG=NOT_WHEN_IDLE NUM_TASKS=2 TASKS_PER_PROCESSOR=1 NUM_PHASES=2
// finds BUG=OWN_AS_PUBLISHED NUM_TASKS=4 TASKS_PER_PROCESSOR=2 NUM_PHASES=2
// finds BUG=CACHE_LAST NUM_TASKS=3 PLACES=ANY NUM_PROCESSORS=2 NUM_PHASES=2
// finds BUG=OLD_PHASE NUM_TASKS=4 TASKS_PER_PROCESSOR=2 NUM_PHASES=2
// finds BUG=LATE NUM_TASKS=2 NUM_PTHREADS=1 TASKS_PER_PROCESSOR=1 NUM_PHASES=1
// finds BUG=EQUAL NUM_TASKS=3 TASKS_PER_PROCESSOR=1 NUM_PHASES=2
// finds BUG=STEPS NUM_TASKS=3 TASKS_PER_PROCESSOR=1 NUM_PTHREADS=2 NUM_PHASES=2
//
// A comment "source: text" says which text of macrotask/source the line models.

#define SET 1
#define PUBLISH_TWICE 2
#define NOT_WHEN_IDLE 3
#define OWN_AS_PUBLISHED 4
#define CACHE_LAST 5
#define OLD_PHASE 6
#define LATE 7
#define EQUAL 8
#define STEPS 9

#define ANY 1

#ifndef NUM_PTHREADS
#define NUM_PTHREADS 0
#endif
#define NUM_LOGICAL (NUM_TASKS - NUM_PTHREADS)
#if PLACES != ANY
#define NUM_PROCESSORS ((NUM_LOGICAL + TASKS_PER_PROCESSOR - 1) / \
                        TASKS_PER_PROCESSOR)
#endif
#define SLOT_OF_PTHREADS NUM_PROCESSORS
#define NUM_LINES (NUM_PROCESSORS + 1)

byte arrivals[4];
byte slots;  // bit of every line that has been published

byte end_of_phase[4];  // for which a task waits; 0: it does not
byte phase_of[4];  // in which a task has arrived, from 1; no part of it
byte processor_of[4];  // PLACES=ANY: where a task waits, from 1; no part of it

#define BIT_OF(slot) (1 << (slot))

// Reads the lines one after the other.
inline ReadArrivals() {
  // logical_barrier.h: std::uint64_t slots =
  //     slots_.load(std::memory_order_acquire);
  atomic { seen_slots = slots; line = 0; sum = 0 }
  do
  // logical_barrier.h: sum +=
  //     lines_[std::countr_zero(slots)].arrivals.load(
  :: atomic {
       line < NUM_LINES && (seen_slots & BIT_OF(line)) ->
       sum = sum + arrivals[line];
       line++
     }
  :: atomic { line < NUM_LINES && !(seen_slots & BIT_OF(line)) -> line++ }
  :: atomic { line == NUM_LINES -> line = 0; seen_slots = 0; break }
  od
}

// logical_barrier.cc: return (NumArrivals() / num_tasks_ + 1) * num_tasks_;
#define END_OF_PHASE ((sum / NUM_TASKS + 1) * NUM_TASKS)

#define ALL_ARRIVALS (arrivals[0] + arrivals[1] + arrivals[2] + arrivals[3])

// Who waits looks again and again. Few looks begin before there is enough
// to see: that a waiter is lost must not be hidden by its looks.
#ifndef MAX_EARLY_LOOKS
#define MAX_EARLY_LOOKS 2
#endif
#define MAY_LOOK(task) (end_of_phase[task] != 0 && \
                        (ALL_ARRIVALS >= end_of_phase[task] || \
                         num_early_looks < MAX_EARLY_LOOKS))
inline Look(task) {
  is_early = (ALL_ARRIVALS < end_of_phase[task]);
  num_early_looks = num_early_looks + is_early
}

#if BUG == EQUAL
#define IS_PAST(end) (sum == (end))
#elif BUG == OWN_AS_PUBLISHED
#define IS_PAST(end) (sum + pending >= (end))
#else
// logical_barrier.h: return NumArrivals() >= end_of_phase;
#define IS_PAST(end) (sum >= (end))
#endif

inline Leave(task) {
  atomic {
    assert(phase_of[task] * NUM_TASKS == end_of_phase[task]);
    end_of_phase[task] = 0;
    processor_of[task] = 0;
    i = 0;
    do
    :: i < NUM_TASKS ->
       assert(phase_of[i] == phase_of[task] ||
              phase_of[i] == phase_of[task] + 1);
       i++
    :: else -> break
    od;
    i = 0
  }
}

inline Publish() {
  // logical_barrier.cc: TakePart(slot);
  slots = slots | BIT_OF(slot);
  atomic {
#if BUG == SET
    arrivals[slot] = pending;
#else
    // logical_barrier.cc: arrivals.load(std::memory_order_relaxed) +
    //     count.pending,
    arrivals[slot] = arrivals[slot] + pending;
#endif
#if BUG == PUBLISH_TWICE
    published++;
    if
    :: published == 2 -> published = 0; pending = 0
    :: else
    fi
#else
    pending = 0  // logical_barrier.cc: count.pending = 0;
#endif
  }
}

inline Arrive(task) {
  if
  // logical_barrier.cc: if (count.pending == 0) return SyncFirst(processor,
  //     count);
#if BUG == OLD_PHASE
  :: last_end == 0 ->
#else
  :: pending == 0 ->
#endif
     // logical_barrier.cc: const std::uint64_t end = EndOfPhase();
     ReadArrivals();
     last_end = END_OF_PHASE;
     sum = 0
  :: else
  fi;
  atomic {
    // logical_barrier.cc: ++count.pending;
    pending++;
    phase_of[task]++;
    // logical_barrier.cc: processor->WaitAt(*this, count.end_of_phase,
    //     waited_);
    end_of_phase[task] = last_end
  }
}

#if PLACES == ANY
#define MAY_BE_OF(task) ((task) < NUM_LOGICAL)
#define IS_OF(task) (MAY_BE_OF(task) && (processor_of[task] == 0 || \
                                         processor_of[task] == slot + 1))
#else
#define MAY_BE_OF(task) ((task) < NUM_LOGICAL && \
                         (task) / TASKS_PER_PROCESSOR == slot)
#define IS_OF(task) MAY_BE_OF(task)
#endif

#define MAY_ARRIVE(task) (IS_OF(task) && end_of_phase[task] == 0 && \
                          phase_of[task] < NUM_PHASES)
#define HAS_ENDED(task) (!MAY_BE_OF(task) || (end_of_phase[task] == 0 && \
                                              phase_of[task] == NUM_PHASES))

active [NUM_PROCESSORS] proctype Processor() {
  byte slot = _pid;
  // logical_barrier.h: std::uint64_t complete = 0; // arrivals of phases known
  //     to be complete std::uint64_t end_of_phase = 0; // of the last arrival
  //     std::uint64_t pending = 0; // arrivals that are not published
  byte complete, last_end, pending;
  byte task, num_early_looks, sum, line, seen_slots, i;
  bool is_early;
#if BUG == PUBLISH_TWICE
  byte published;
#endif
  do
  :: atomic {
       if
       :: MAY_ARRIVE(0) -> task = 0
       :: MAY_ARRIVE(1) -> task = 1
       :: MAY_ARRIVE(2) -> task = 2
       :: MAY_ARRIVE(3) -> task = 3
       fi;
       processor_of[task] = slot + 1
     }
     Arrive(task);
     task = 0
  :: atomic {
       if
       :: IS_OF(0) && MAY_LOOK(0) -> task = 0
       :: IS_OF(1) && MAY_LOOK(1) -> task = 1
       :: IS_OF(2) && MAY_LOOK(2) -> task = 2
       :: IS_OF(3) && MAY_LOOK(3) -> task = 3
       fi;
       Look(task)
     }
     if
     // logical_barrier.h: if (count.complete >= end_of_phase) return true; if
     //     (!IsPast(end_of_phase)) return false; count.complete = end_of_phase;
     :: complete >= end_of_phase[task] -> Leave(task)
     :: else ->
        ReadArrivals();
        if
#if BUG == CACHE_LAST
        :: IS_PAST(end_of_phase[task]) -> complete = last_end; Leave(task)
#else
        :: IS_PAST(end_of_phase[task]) ->
           complete = end_of_phase[task];
           Leave(task)
#endif
        :: else -> assert(is_early)
        fi
     fi;
     task = 0;
     is_early = false;
     sum = 0
#if BUG == NOT_WHEN_IDLE
  :: pending != 0 && (MAY_ARRIVE(0) || MAY_ARRIVE(1)) -> Publish()
#else
  // logical_barrier.cc: processor->FlushLater(this);
  :: pending != 0 -> Publish()
#endif
  :: HAS_ENDED(0) && HAS_ENDED(1) && HAS_ENDED(2) && HAS_ENDED(3) -> break
  od
}

#if NUM_PTHREADS > 0
active [NUM_PTHREADS] proctype Pthread() {
  byte task = _pid - NUM_PROCESSORS + NUM_LOGICAL;
  byte num_early_looks, sum, line, seen_slots, i;
  bool is_early;
  do
  :: phase_of[task] < NUM_PHASES ->
#if BUG != LATE
     // logical_barrier.cc: const std::uint64_t end_of_phase = EndOfPhase();
     ReadArrivals();
#endif
     // logical_barrier.cc: TakePart(kSlotOfPthreads);
     slots = slots | BIT_OF(SLOT_OF_PTHREADS);
#if BUG == STEPS
     i = arrivals[SLOT_OF_PTHREADS];
     atomic { phase_of[task]++; arrivals[SLOT_OF_PTHREADS] = i + 1; i = 0 }
#else
     // logical_barrier.cc: lines_[kSlotOfPthreads].arrivals.fetch_add(1,
     //     std::memory_order_release);
     atomic { phase_of[task]++; arrivals[SLOT_OF_PTHREADS]++ }
#endif
#if BUG == LATE
     ReadArrivals();
#endif
     atomic { end_of_phase[task] = END_OF_PHASE; sum = 0 }
     do
     :: atomic { MAY_LOOK(task) -> Look(task) }
        ReadArrivals();
        if
        :: IS_PAST(end_of_phase[task]) -> Leave(task)
        :: else -> assert(is_early)
        fi;
        is_early = false;
        sum = 0
     :: end_of_phase[task] == 0 -> break
     od
  :: else -> break
  od
}
#endif
