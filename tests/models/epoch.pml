// Epoch, macrotask/epoch.cc, in three programs:
//
// COUNT    NUM_ADVANCERS tasks advance NUM_ADVANCES times each, while
//          NUM_WAITERS tasks wait for one epoch after the other.
// DESTROY  one task advances once; the one that it releases destroys the epoch.
// EVENT    two tasks post and clear (as Event does) what a third one waits for.
//
// Proved: whoever returns finds the epoch past (assertion); nobody waits for
// ever (no state in which all that remain are blocked); nothing of the object
// is touched once the released task has destroyed it (assertion).
//
// proves PROGRAM=COUNT NUM_ADVANCERS=1 NUM_ADVANCES=3 NUM_WAITERS=2
// proves PROGRAM=COUNT NUM_ADVANCERS=2 NUM_ADVANCES=1 NUM_WAITERS=2
// proves PROGRAM=COUNT NUM_ADVANCERS=3 NUM_ADVANCES=1 NUM_WAITERS=1
// proves PROGRAM=DESTROY
// proves PROGRAM=EVENT
// finds BUG=NO_COMPARE PROGRAM=DESTROY
// finds BUG=WAIT_FOR_WORD PROGRAM=DESTROY
// finds BUG=WAKE_OUTSIDE_GUARD PROGRAM=DESTROY
// finds BUG=NO_MAX PROGRAM=COUNT NUM_ADVANCERS=2 NUM_ADVANCES=1 NUM_WAITERS=2
// finds BUG=WAIT_FOR_POSTED PROGRAM=EVENT
//
// A comment "source: text" says which text of macrotask/source the line models.

#define NO_COMPARE 1
#define WAIT_FOR_WORD 2
#define WAKE_OUTSIDE_GUARD 3
#define NO_MAX 4
#define WAIT_FOR_POSTED 5

#define COUNT 1
#define DESTROY 2
#define EVENT 3

#if PROGRAM == DESTROY
#define NUM_ADVANCERS 1
#define NUM_ADVANCES 1
#define NUM_WAITERS 1
#elif PROGRAM == EVENT
#define NUM_ADVANCERS 2
#define NUM_ADVANCES 2
#define NUM_WAITERS 1
#endif

#include "sleep.pml"

// The two halves of word_, read and written together.
byte epoch;
bool somebody_sleeps;
byte released;  // epoch.h: released_ =

bool is_destroyed;  // no part of it
bool about_to_wait;

#define TOUCH assert(!is_destroyed)

inline WakeSleepers(now) {
  TOUCH;
  LockMutex();
  atomic {
    TOUCH;
#if BUG == NO_MAX
    released = now;
#else
    // epoch.cc: released_ = std::max(released_, epoch);
    released = (released > now -> released : now);
#endif
  }
#if BUG == WAKE_OUTSIDE_GUARD
  atomic { TOUCH; UnlockMutex() };
  atomic { TOUCH; WakeAll() }
#else
  // epoch.cc: wake_.WakeAll(); } void Epoch::SleepPast
  atomic { TOUCH; WakeAll() };
  atomic { TOUCH; UnlockMutex() }
#endif
}

// Advance(); AdvanceIf(parity) if the epoch has that parity, and nothing if not
// (what a store of the same word is worth only a weak memory shows).
inline AdvanceIf(condition) {
  // epoch.cc: while (!word_.compare_exchange_weak(word, WordOf(EpochOf(word) +
  //     1),
  // epoch.cc: } while (!word_.compare_exchange_weak(word, next,
  //     std::memory_order_acq_rel,
  // Of one advancer, AdvanceTo(epoch + 1) as well:
  // epoch.cc: word_.exchange(WordOf(epoch), std::memory_order_release);
  // epoch.cc: if (word & kSomebodySleeps) WakeSleepers(epoch);
  atomic {
    TOUCH;
    if
    :: condition ->
       epoch++;
       now = epoch;
       sleeps = somebody_sleeps;
       // epoch.cc: std::uint64_t WordOf(std::uint64_t epoch) { return epoch <<
       //     1; }
       somebody_sleeps = false
    :: else -> sleeps = false
    fi
  }
  if
  // epoch.cc: if (word & kSomebodySleeps) WakeSleepers(EpochOf(word) + 1);
  :: sleeps -> WakeSleepers(now)
  :: else
  fi;
  atomic { sleeps = false; now = 0 }
}

inline SleepPast(task, seen) {
  LockMutex();
  // epoch.cc: std::uint64_t word = word_.load(std::memory_order_acquire);
  now = epoch; sleeps = somebody_sleeps;
  do
  // epoch.cc: while (EpochOf(word) <= seen && !(word & kSomebodySleeps)) {
  :: now <= seen && !sleeps ->
     // epoch.cc: if (word_.compare_exchange_weak(word, word | kSomebodySleeps,
     atomic {
       if
#if BUG == NO_COMPARE
       :: somebody_sleeps = true; break
#else
       :: epoch == now && somebody_sleeps == sleeps ->
          somebody_sleeps = true;
          break
#endif
       :: now = epoch; sleeps = somebody_sleeps  // It fails.
       fi
     }
  :: else -> break
  od;
  if
  :: now > seen  // epoch.cc: if (EpochOf(word) > seen) return;
  :: else ->
     do
#if BUG == WAIT_FOR_WORD
     :: epoch <= seen -> WaitCondition(task)
#else
     // epoch.cc: while (released_ <= seen) wake_.Wait(mutex_);
     :: released <= seen -> WaitCondition(task)
#endif
     :: else -> break
     od
  fi;
  UnlockMutex();
  atomic { now = 0; sleeps = false }
}

inline AwaitPast(task, seen) {
  // epoch.cc: policy, what, [&] { return Read() > seen; }, [&] {
  //     SleepPast(seen); });
  if
  :: epoch > seen
  :: SleepPast(task, seen)
  fi
}

active [NUM_ADVANCERS] proctype Advancer() {
  byte i, now;
  bool sleeps;
#if PROGRAM == EVENT
  about_to_wait;
  AdvanceIf(epoch % 2 == 0);  // event.h: epoch_.AdvanceIfEven();
  AdvanceIf(epoch % 2 == 1)  // event.h: epoch_.AdvanceIfOdd();
#else
  do
  :: i < NUM_ADVANCES -> AdvanceIf(true); i++
  :: else -> break
  od
#endif
}

active [NUM_WAITERS] proctype Waiter() {
  byte task = _pid;  // Of nobody else who sleeps; Nature is 0.
  byte now, seen;
  bool sleeps;
#if PROGRAM == EVENT
  // event.cc: const std::uint64_t seen = epoch_.Read();
  atomic { seen = epoch; about_to_wait = true }
#if BUG == WAIT_FOR_POSTED
  epoch % 2 == 1;
#else
  AwaitPast(task, seen);  // event.cc: epoch_.AwaitPast(seen, policy_, waited_);
#endif
  assert(epoch > seen)
#else
  do
  :: seen < NUM_ADVANCERS * NUM_ADVANCES ->
     AwaitPast(task, seen);
     assert(epoch > seen);
#if PROGRAM == DESTROY
     is_destroyed = true;
     break
#else
     if
     :: seen = epoch
     :: seen++  // Others may have seen later epochs and wait for those.
     fi
#endif
  :: else -> break
  od
#endif
}
