// CountingBarrier, macrotask/counting_barrier.cc: NUM_TASKS tasks go through
// NUM_PHASES phases. Every policy at once: a waiting task spins for as long as
// it likes, then perhaps sleeps.
//
// Proved: nobody leaves phase k before all have arrived in it (assertion), and
// nobody waits for ever (no state in which all that remain are blocked).
//
// proves NUM_TASKS=2 NUM_PHASES=4
// proves NUM_TASKS=3 NUM_PHASES=3
// proves NUM_TASKS=4 NUM_PHASES=2 MAX_STRAY_WAKES=0
// finds BUG=BIT_OUTSIDE_MUTEX NUM_TASKS=2 NUM_PHASES=2
// finds BUG=EQUAL NUM_TASKS=2 NUM_PHASES=2
// finds BUG=WAKE_BEFORE_CLEARING NUM_TASKS=2 NUM_PHASES=2
// finds BUG=NO_SECOND_LOOK NUM_TASKS=2 NUM_PHASES=2
// finds BUG=NO_COMPARE NUM_TASKS=2 NUM_PHASES=2
//
// A comment "source: text" says which text of macrotask/source the line models.

#define BIT_OUTSIDE_MUTEX 1
#define EQUAL 2
#define WAKE_BEFORE_CLEARING 3
#define NO_SECOND_LOOK 4
#define NO_COMPARE 5

#include "sleep.pml"

// The two halves of word_, read and written together.
byte arrivals;
bool somebody_sleeps;

byte phase_of[NUM_TASKS];  // in which a task has arrived, from 1; no part of it

#if BUG == EQUAL
#define PHASE_COMPLETE (arrivals == end_of_phase)
#else
// counting_barrier.cc: ArrivalsOf(word_.load(std::memory_order_acquire)) >=
//     end_of_phase
#define PHASE_COMPLETE (arrivals >= end_of_phase)
#endif

inline WakeSleepers() {
#if BUG == WAKE_BEFORE_CLEARING
  WakeAll();
#endif
  LockMutex();
  // counting_barrier.cc: word_.fetch_and(~kSomebodySleeps,
  //     std::memory_order_relaxed);
  somebody_sleeps = false;
  UnlockMutex();
#if BUG != WAKE_BEFORE_CLEARING
  WakeAll();  // counting_barrier.cc: } // Outside the guard
#endif
}

inline SleepUntil(task) {
#if BUG == BIT_OUTSIDE_MUTEX
  do
  :: atomic { PHASE_COMPLETE -> break }
  :: atomic { !PHASE_COMPLETE -> somebody_sleeps = true };
     LockMutex();
     WaitCondition(task);
     UnlockMutex()
  od;
#else
  LockMutex();
  do
  :: atomic {
       seen = arrivals; sleeps = somebody_sleeps;
       if
       // counting_barrier.cc: if (ArrivalsOf(word) >= end_of_phase) return;
       :: PHASE_COMPLETE -> break
       :: else
       fi
     }
     if
     :: sleeps  // counting_barrier.cc: if (!(word & kSomebodySleeps) &&
     :: else ->
        // counting_barrier.cc: !word_.compare_exchange_weak(word, word |
        //     kSomebodySleeps,
        atomic {
          if
#if BUG == NO_COMPARE
          :: somebody_sleeps = true; sleeps = true
#else
          :: arrivals == seen && !somebody_sleeps ->
             somebody_sleeps = true; sleeps = true
#endif
          :: skip  // it fails, for no reason or for a good one
          fi
        }
     fi;
     if
     // counting_barrier.cc: wake_.Wait(mutex_);
     :: sleeps -> WaitCondition(task)
#if BUG == NO_SECOND_LOOK
        ; break
#endif
     :: else  // counting_barrier.cc: continue;
     fi
  od;
  UnlockMutex();
#endif
  seen = 0; sleeps = false
}

inline Sync(task) {
  atomic {
    // counting_barrier.cc: word_.fetch_add(kOneArrival,
    //     std::memory_order_acq_rel);
    seen = arrivals; sleeps = somebody_sleeps;
    arrivals++;
    phase_of[task]++;
    // counting_barrier.cc: end_of_phase = (arrivals / num_tasks_ + 1) *
    //     num_tasks_;
    end_of_phase = (seen / NUM_TASKS + 1) * NUM_TASKS
  }
  if
  // counting_barrier.cc: if (arrivals + 1 == end_of_phase) {
  :: seen + 1 == end_of_phase ->
     if
     // counting_barrier.cc: if (word & kSomebodySleeps) WakeSleepers();
     :: sleeps -> WakeSleepers()
     :: else
     fi
  :: else ->
     // counting_barrier.cc: SpinThenSleep(policy_, waited_, phase_complete,
     seen = 0; sleeps = false;
     if
     :: PHASE_COMPLETE
     :: SleepUntil(task)
     fi
  fi;
  seen = 0; sleeps = false; end_of_phase = 0
}

active [NUM_TASKS] proctype Task() {
  byte task = _pid - 1;  // Nature is 0.
  byte seen, end_of_phase, other, phase;
  bool sleeps;
  do
  :: phase < NUM_PHASES ->
     Sync(task);
     d_step {
       phase++;
       other = 0;
       do
       :: other < NUM_TASKS ->
          assert(phase_of[other] == phase || phase_of[other] == phase + 1);
          other++
       :: else -> break
       od;
       other = 0
     }
  :: else -> break
  od
}
