// Lock, macrotask/lock.cc. The epoch by which a waiter is handed the lock is a
// bit here: epoch.pml shows what it does, and that whom it has released may
// destroy it. Two programs:
//
// LOCK   NUM_TASKS tasks lock and unlock NUM_TURNS times, by On() or by Test()
//        as they like, after somebody has unlocked the clear lock.
// TWICE  Two tasks unlock the lock of a third one at the same time while
//        NUM_TASKS tasks lock and unlock: nobody is promised to be alone, but
//        nobody may be lost.
//
// Proved: no two tasks hold the lock (assertion); nobody gets it before one who
// has queued earlier (assertion); nobody waits for ever (no state in which all
// that remain are blocked); nobody touches the waiter of one who has gone
// (assertion); at the end the lock is clear and nobody queues (assertion).
//
// proves PROGRAM=LOCK NUM_TASKS=2 NUM_TURNS=3
// proves PROGRAM=LOCK NUM_TASKS=3 NUM_TURNS=2
// proves PROGRAM=LOCK NUM_TASKS=4 NUM_TURNS=1
// proves PROGRAM=TWICE NUM_TASKS=2 NUM_TURNS=1
// finds BUG=CLEAR_THEN_HAND_OVER PROGRAM=LOCK NUM_TASKS=3 NUM_TURNS=1
// finds BUG=NO_COMPARE PROGRAM=LOCK NUM_TASKS=2 NUM_TURNS=1
// finds BUG=FORGET_QUEUE PROGRAM=LOCK NUM_TASKS=3 NUM_TURNS=1
// finds BUG=LAST_FIRST PROGRAM=LOCK NUM_TASKS=3 NUM_TURNS=1
// finds BUG=READ_AFTER_HAND_OVER PROGRAM=LOCK NUM_TASKS=2 NUM_TURNS=1
// finds BUG=EXPECT_A_WAITER PROGRAM=TWICE NUM_TASKS=2 NUM_TURNS=1
//
// A comment "source: text" says which text of macrotask/source the line models.

#define CLEAR_THEN_HAND_OVER 1
#define NO_COMPARE 2
#define FORGET_QUEUE 3
#define LAST_FIRST 4
#define READ_AFTER_HAND_OVER 5
#define EXPECT_A_WAITER 6

#define LOCK 1
#define TWICE 2

#define MAX_STRAY_WAKES 0
#include "sleep.pml"

#define NOBODY 255
#define CLEAR 0
#define QUEUED 1
#define SET_BY(task) (((task) + 1) << 1)

byte state;  // holder << 1 | somebody_is_queued
byte head = NOBODY;
byte tail = NOBODY;
byte next[NUM_TASKS + 3];
bool handed_over[NUM_TASKS + 3];
bool waiter_lives[NUM_TASKS + 3];

// No part of it.
byte num_holders;
byte num_tickets;
byte ticket[NUM_TASKS + 3];
byte last_ticket;
byte num_done;

#if PROGRAM == LOCK
#define HOLD assert(num_holders == 0); num_holders++
#define LET_GO num_holders--
#else
#define HOLD
#define LET_GO
#endif

// Sets `got`. In one step with `also`, if it succeeds.
inline TryOn(task) {
  atomic {
    if
    // lock.cc: return state_.compare_exchange_strong(expected,
    //     SetBy(number_of_caller),
    :: state == CLEAR ->
       state = SET_BY(task);
       assert(head == NOBODY);
       HOLD;
       got = true
    :: else -> got = false
    fi
  }
}

// Sets `got` if the caller now holds the lock.
inline Enqueue(task) {
  LockMutex();
  got = false;
  if
  // lock.cc: if (head_ == nullptr) { std::uint64_t state =
  //     state_.load(std::memory_order_relaxed);
  :: head == NOBODY ->
     seen = state;
     do
     :: seen != CLEAR ->
#if BUG == NO_COMPARE
        state = seen | QUEUED;
        break
#else
        // lock.cc: !state_.compare_exchange_weak(state, state | kQueued,
        atomic {
          if
          :: state == seen -> state = seen | QUEUED; break
          :: seen = CLEAR  // It fails.
          fi
        }
#endif
     :: else ->
        TryOn(task);  // lock.cc: if (TryOn()) return false;
        if
        :: got -> break
        :: else -> seen = state
        fi
     od;
     if
     :: got
     :: else ->
        atomic {
          head = task;  // lock.cc: head_ = &self;
          tail = task;
          ticket[task] = num_tickets; num_tickets++
        }
     fi
  :: else ->
#if BUG == LAST_FIRST
     atomic { next[task] = head; head = task };
#else
     // lock.cc: tail_->next = &self;
     atomic { assert(waiter_lives[tail]); next[tail] = task };
     tail = task;  // lock.cc: tail_ = &self;
#endif
     atomic { ticket[task] = num_tickets; num_tickets++ }
  fi;
  UnlockMutex();
  seen = 0
}

inline On(task) {
  TryOn(task);
  if
  :: got  // lock.cc: if (TryOn()) return;
  :: else ->
     // lock.cc: Waiter self; if (!Enqueue(self)) return;
     atomic {
       next[task] = NOBODY; handed_over[task] = false; waiter_lives[task] = true
     }
     Enqueue(task);
     if
     :: got
     :: else ->
        // lock.cc: self.handed_over.AwaitPast(0, policy_, {ObjectKind::kLock,
        //     number_, this});
        atomic { handed_over[task] -> HOLD }
     fi;
     atomic {
       waiter_lives[task] = false;
       handed_over[task] = false; next[task] = 0; ticket[task] = 0
     }
  fi;
  got = false
}

inline HandOver(task) {
  // lock.cc: next_holder->handed_over.Advance();
  atomic {
    assert(waiter_lives[task]);
#if PROGRAM == LOCK
    assert(ticket[task] == last_ticket);
    last_ticket++;
#endif
    handed_over[task] = true
  }
}

inline Off(task) {
  // lock.cc: std::uint64_t state = SetBy(number_of_caller);
  seen = SET_BY(task);
  LET_GO;
  do
  :: atomic {
       // lock.cc: while (!(state & kQueued)) { if
       //     (state_.compare_exchange_strong(state, kClear,
       //     std::memory_order_release,
       (seen & QUEUED) == 0 ->
       if
       :: state == seen -> state = CLEAR; cleared = true; break
       :: else -> seen = state
       fi
     }
  :: else -> break
  od;
  if
  :: cleared
  :: else ->
     LockMutex();
     heir = head;  // lock.cc: next_holder = head_;
     if
#if BUG != EXPECT_A_WAITER
     // lock.cc: if (next_holder == nullptr) {
     :: heir == NOBODY -> state = CLEAR; UnlockMutex()
#endif
     :: else ->
#if BUG == READ_AFTER_HAND_OVER
        HandOver(heir);
#endif
        assert(waiter_lives[heir]);
        head = next[heir];  // lock.cc: head_ = next_holder->next;
#if BUG == FORGET_QUEUE
        state = SET_BY(heir);
#elif BUG == CLEAR_THEN_HAND_OVER
        state = (head != NOBODY -> SET_BY(heir) | QUEUED : CLEAR);
#else
        // lock.cc: state_.store(SetBy(next_holder->task) | (head_ != nullptr ?
        //     kQueued : 0),
        state = SET_BY(heir) | (head != NOBODY -> QUEUED : 0);
#endif
        UnlockMutex();
#if BUG != READ_AFTER_HAND_OVER
        HandOver(heir)
#endif
     fi
  fi;
  atomic { seen = 0; cleared = false; heir = 0 }
}

inline Test(task) {
  if
  // lock.cc: state_.load(std::memory_order_relaxed) != kClear || !TryOn();
  :: state != CLEAR -> got = false
  :: else -> TryOn(task)
  fi
}

bool ready;

active proctype Initial() {
  byte task = NUM_TASKS;
  byte seen, heir;
  bool got, cleared;
  num_holders = 1;  // What this Off() lets go is nothing.
  Off(task);
  assert(state == CLEAR);
  num_holders = 0;
#if PROGRAM == TWICE
  On(task);
#endif
  ready = true;
  num_done == NUM_TASKS + (PROGRAM == TWICE -> 2 : 0);
  assert(head == NOBODY && !(state & QUEUED));
#if PROGRAM == LOCK
  assert(state == CLEAR)
#endif
}

active [NUM_TASKS] proctype Task() {
  byte task = _pid - 2;  // Nature is 0, Initial 1.
  byte turn, seen, heir;
  bool got, cleared;
  ready;
  do
  :: turn < NUM_TURNS ->
     if
     :: true ->
        On(task);
        Off(task)
     :: true ->
        Test(task);
        if
        :: got -> got = false; Off(task)
        :: else
        fi
     fi;
     turn++
  :: else -> break
  od;
  num_done++
}

#if PROGRAM == TWICE
active [2] proctype Unlocker() {
  byte task = _pid - 1;  // After Task.
  byte seen, heir;
  bool cleared;
  ready;
  Off(task);
  num_done++
}
#endif
