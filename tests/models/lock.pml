// Lock, macrotask/lock.h and lock.cc. The epoch by which a waiter is handed the
// lock is a bit here: epoch.pml shows what it does, and that whom it has
// released may destroy it. Two programs:
//
// LOCK   NUM_TASKS tasks lock and unlock NUM_TURNS times, by On() or by Test()
//        as they like, after somebody has unlocked the clear lock.
// TWICE  Two tasks unlock the lock of a third one at the same time while
//        NUM_TASKS tasks lock and unlock: nobody is promised to be alone, but
//        nobody may be lost.
//
// Each task has a store buffer for the one store that may be late: that of
// Off(), in the memory at any time from then on, but before the task's next
// atomic read-modify-write, and at the latest when another task calls
// HeavyFence(). Whether stores begin again after an exchange is left to chance.
//
// Proved: no two tasks hold the lock (assertion); nobody gets it before one who
// has queued earlier, nor, by On() or Test(), before one who had queued when
// that was called (assertions); nobody waits for ever (no state in which all
// that remain are blocked); nobody touches the waiter of one who has gone
// (assertion); at the end the lock is clear and nobody queues (assertion).
//
// proves PROGRAM=LOCK NUM_TASKS=2 NUM_TURNS=3
// proves PROGRAM=LOCK NUM_TASKS=3 NUM_TURNS=1
// proves PROGRAM=TWICE NUM_TASKS=2 NUM_TURNS=1
// finds BUG=CLEAR_THEN_HAND_OVER PROGRAM=LOCK NUM_TASKS=3 NUM_TURNS=1
// finds BUG=NO_COMPARE PROGRAM=LOCK NUM_TASKS=2 NUM_TURNS=1
// finds BUG=FORGET_QUEUE PROGRAM=LOCK NUM_TASKS=3 NUM_TURNS=1
// finds BUG=LAST_FIRST PROGRAM=LOCK NUM_TASKS=3 NUM_TURNS=1
// finds BUG=READ_AFTER_HAND_OVER PROGRAM=LOCK NUM_TASKS=2 NUM_TURNS=1
// finds BUG=EXPECT_A_WAITER PROGRAM=TWICE NUM_TASKS=2 NUM_TURNS=1
// finds BUG=NO_HEAVY_FENCE PROGRAM=LOCK NUM_TASKS=2 NUM_TURNS=1
// finds BUG=FENCE_FIRST PROGRAM=LOCK NUM_TASKS=2 NUM_TURNS=1
// finds BUG=NO_SECOND_LOOK PROGRAM=LOCK NUM_TASKS=2 NUM_TURNS=1
// finds BUG=LOOK_AT_QUEUE PROGRAM=TWICE NUM_TASKS=2 NUM_TURNS=2
// finds BUG=STORES_AT_ONCE PROGRAM=LOCK NUM_TASKS=3 NUM_TURNS=1
// finds BUG=GET_PAST PROGRAM=LOCK NUM_TASKS=3 NUM_TURNS=1
// finds BUG=TAKE_FOR_CLEAR PROGRAM=LOCK NUM_TASKS=3 NUM_TURNS=1
//
// A comment "source: text" says which text of macrotask/source the line models.

#define CLEAR_THEN_HAND_OVER 1
#define NO_COMPARE 2
#define FORGET_QUEUE 3
#define LAST_FIRST 4
#define READ_AFTER_HAND_OVER 5
#define EXPECT_A_WAITER 6
#define NO_HEAVY_FENCE 7
#define FENCE_FIRST 8
#define NO_SECOND_LOOK 9
#define LOOK_AT_QUEUE 10
#define STORES_AT_ONCE 11
#define GET_PAST 12
#define TAKE_FOR_CLEAR 13

#define LOCK 1
#define TWICE 2

#define MAX_STRAY_WAKES 0
#include "sleep.pml"

#define NOBODY 255
#define CLEAR 0
#define QUEUED 1
#define SET_BY(task) (((task) + 1) << 1)

byte state;  // holder << 1 | somebody_is_queued
bool stores = true;  // clearing_ is kByStore
byte head = NOBODY;
byte tail = NOBODY;
byte next[NUM_TASKS + 3];
bool handed_over[NUM_TASKS + 3];
bool waiter_lives[NUM_TASKS + 3];

// Bit of every task whose store of CLEAR is not in the memory yet.
byte late;

// No part of it.
byte num_holders;
byte num_tickets;
byte num_served;
byte ticket[NUM_TASKS + 3];
byte num_done;

#if PROGRAM == LOCK
#define HOLD assert(num_holders == 0); num_holders++
#define LET_GO num_holders--
// All who had queued when the task began have been served.
#define IN_TURN assert(num_served >= began)
#define SERVE(task) assert(ticket[task] == num_served); num_served++
#else
#define HOLD skip
#define LET_GO skip
#define IN_TURN skip
#define SERVE(task) skip
#endif

// Within an atomic step: what a read-modify-write waits for.
inline Drain(task) {
  if
  :: late & BIT_OF(task) -> late = late & ~BIT_OF(task); state = CLEAR
  :: else
  fi
}

// Stores reach the memory by themselves, one day.
active proctype Memory() {
  byte i;
end:
  do
  :: late != 0 ->
     atomic {
       i = 0;
       do
       :: i < NUM_TASKS + 2 -> i++
       :: break
       od;
       Drain(i);
       i = 0
     }
  od
}

// The task sees its own store at once.
#define STATE_SEEN_BY(task) (late & BIT_OF(task) -> CLEAR : state)

inline HeavyFence() {
#if BUG == NO_HEAVY_FENCE
  skip
#else
  atomic {
    if
    :: late != 0 -> late = 0; state = CLEAR
    :: else
    fi
  }
#endif
}

inline LockMutexBy(task) {
  atomic { !mutex_is_locked -> mutex_is_locked = true; Drain(task) }
}

// Sets `got`.
inline TryOn(task) {
  if
#if BUG != GET_PAST
  // lock.h: if (head_.load(std::memory_order_relaxed) != nullptr) return false;
  :: head != NOBODY -> got = false
#endif
  :: else ->
     atomic {
       Drain(task);
       if
       // lock.h: return state_.compare_exchange_strong(expected,
       //     SetBy(number_of_caller),
       :: state == CLEAR ->
          state = SET_BY(task);
          IN_TURN;
          HOLD;
          got = true
       :: else -> got = false
       fi
     }
  fi
}

inline Dequeue(who) {
  // lock.cc: head_.store(head->next, std::memory_order_relaxed);
  atomic { who = head; assert(waiter_lives[who]); head = next[who] }
}

// Sets `heir` to who now holds the lock, or to NOBODY.
inline Settle() {
  heir = NOBODY;
  assert(waiter_lives[head]);
  // lock.cc: std::uint64_t state = state_.load(std::memory_order_relaxed);
  seen = state;
  do
  // lock.cc: while (!(state & kQueued)) {
  //     const bool is_clear = state == kClear;
  :: seen & QUEUED -> break
  :: else ->
#if BUG == NO_COMPARE
     if
     :: seen != CLEAR -> state = seen | QUEUED; break
     :: else
     fi;
#endif
     // lock.cc: if (state_.compare_exchange_weak(
     //     state, is_clear ? handed_over : state | kQueued,
     atomic {
       if
       :: state != seen -> seen = state
#if BUG == TAKE_FOR_CLEAR
       :: state == seen ->
#else
       :: state == seen && seen != CLEAR -> state = seen | QUEUED; break
       :: state == seen && seen == CLEAR ->
#endif
          // lock.cc: SetBy(head->task) | (head->next != nullptr ? kQueued : 0);
          heir = head;
          state = SET_BY(heir) | (next[heir] != NOBODY -> QUEUED : 0)
       // It may also fail for no reason: the same round once more.
       fi
     };
     if
     :: heir != NOBODY -> Dequeue(heir); break
     :: else
     fi
  od;
  seen = 0
}

inline EndStores() {
  if
  // lock.cc: if (clearing_.load(std::memory_order_relaxed) == kByExchange)
  //     return;
  :: !stores
  :: else ->
#if BUG == FENCE_FIRST
     HeavyFence();
     stores = false
#else
     // lock.cc: clearing_.store(kByExchange, std::memory_order_relaxed);
     //     HeavyFence();
     stores = false;
     HeavyFence()
#endif
  fi
}

inline BeginStores(task) {
  LockMutexBy(task);
  if
#if BUG != STORES_AT_ONCE
  // lock.cc: if (head_.load(std::memory_order_relaxed) != nullptr) return;
  :: head != NOBODY
#endif
  // lock.cc: clearing_.store(kByStore, std::memory_order_relaxed);
  :: else -> stores = true
  fi;
  UnlockMutex()
}

// Sets `got` if the caller now holds the lock.
inline Enqueue(task) {
  LockMutexBy(task);
  if
  // lock.cc: if (head_.load(std::memory_order_relaxed) != nullptr) {
  //     tail_->next = &self; tail_ = &self; return true;
  :: head != NOBODY ->
#if BUG == LAST_FIRST
     atomic { next[task] = head; head = task };
#else
     atomic { assert(waiter_lives[tail]); next[tail] = task };
     tail = task;
#endif
     atomic { ticket[task] = num_tickets; num_tickets++ };
     got = false
  :: else ->
     EndStores();  // lock.cc: EndStores();
     atomic {
       // lock.cc: head_.store(&self, std::memory_order_relaxed); tail_ = &self;
       head = task;
       tail = task;
       ticket[task] = num_tickets; num_tickets++
     };
     Settle();  // lock.cc: return Settle() == nullptr;
     atomic {
       got = (heir == task);
       if
       :: got -> SERVE(task); HOLD
       :: else
       fi
     }
  fi;
  UnlockMutex();
  heir = 0
}

inline On(task) {
  began = num_tickets;
  TryOn(task);  // lock.h: if (!TryOn()) AwaitTurn();
  if
  :: got
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
  atomic { got = false; began = 0 }
}

inline Advance(task) {
  atomic { assert(waiter_lives[task]); SERVE(task); handed_over[task] = true }
}

inline HandOver(task) {
  LockMutexBy(task);
  if
#if BUG != EXPECT_A_WAITER
  // lock.cc: if (head_.load(std::memory_order_relaxed) == nullptr) {
  //     // Somebody else has unlocked meanwhile
  :: head == NOBODY -> state = CLEAR; UnlockMutex()
#endif
  :: else ->
#if BUG == READ_AFTER_HAND_OVER
     Advance(head);
#endif
     Dequeue(heir);  // lock.cc: next_holder = Dequeue();
#if BUG == FORGET_QUEUE
     state = SET_BY(heir);
#elif BUG == CLEAR_THEN_HAND_OVER
     state = (head != NOBODY -> SET_BY(heir) | QUEUED : CLEAR);
#else
     // lock.cc: state_.store( SetBy(next_holder->task) | (next_holder->next !=
     //     nullptr ? kQueued : 0),
     state = SET_BY(heir) | (next[heir] != NOBODY -> QUEUED : 0);
#endif
     UnlockMutex();
#if BUG != READ_AFTER_HAND_OVER
     Advance(heir)  // lock.cc: next_holder->handed_over.Advance();
#endif
  fi
}

inline OffByExchange(task) {
  // lock.cc: std::uint64_t state = SetBy(number_of_caller);
  seen = SET_BY(task);
  do
  :: atomic {
       // lock.cc: while (!(state & kQueued)) { if
       //     (state_.compare_exchange_strong(state, kClear,
       //     std::memory_order_release,
       (seen & QUEUED) == 0 ->
       Drain(task);
       if
       :: state == seen -> state = CLEAR; seen = 0; cleared = true; break
       :: else -> seen = state
       fi
     }
  :: else -> break
  od;
  if
  :: cleared  // One of many: num_exchanges_.
  :: cleared -> BeginStores(task)
  :: !cleared -> HandOver(task)  // lock.cc: HandOver(); }
  fi
}

inline HelpQueue(task) {
  LockMutexBy(task);
  if
  // lock.cc: if (head_.load(std::memory_order_relaxed) == nullptr) return;
  //     next_holder = Settle();
  :: head == NOBODY -> UnlockMutex()
  :: else ->
     Settle();
     UnlockMutex();
     if
     // lock.cc: if (next_holder != nullptr) next_holder->handed_over.Advance();
     :: heir != NOBODY -> Advance(heir)
     :: else
     fi
  fi
}

#if BUG == NO_SECOND_LOOK
#define MUST_HELP false
#elif BUG == LOOK_AT_QUEUE
#define MUST_HELP (head != NOBODY)
#else
#define MUST_HELP (!stores)
#endif

inline Off(task) {
  LET_GO;
  if
  // lock.h: if (clearing_.load(std::memory_order_relaxed) != kByStore) { return
  //     OffByExchange();
  :: !stores -> OffByExchange(task)
  :: else ->
     atomic {
       // lock.h: state_.store(kClear, std::memory_order_release); LightFence();
       Drain(task);
       late = late | BIT_OF(task)
     };
     if
     // lock.h: if (clearing_.load(std::memory_order_relaxed) != kByStore)
     //     HelpQueue();
     :: MUST_HELP -> HelpQueue(task)
     :: else
     fi
  fi;
  atomic { seen = 0; cleared = false; heir = 0 }
}

inline Test(task) {
  began = num_tickets;
  if
  // lock.h: state_.load(std::memory_order_relaxed) != kClear || !TryOn();
  :: STATE_SEEN_BY(task) != CLEAR -> got = false
  :: else -> TryOn(task)
  fi;
  began = 0
}

bool ready;

active proctype Initial() {
  byte task = NUM_TASKS;
  byte seen, heir, began;
  bool got, cleared;
  num_holders = 1;  // What this Off() lets go is nothing.
  Off(task);
  assert(STATE_SEEN_BY(task) == CLEAR);
  // Whoever knows of what follows knows of the store.
  atomic { late == 0 -> num_holders = 0 }
#if PROGRAM == TWICE
  On(task);
#endif
  ready = true;
  num_done == NUM_TASKS + (PROGRAM == TWICE -> 2 : 0) && late == 0;
  assert(head == NOBODY && !(state & QUEUED));
#if PROGRAM == LOCK
  assert(state == CLEAR)
#endif
}

active [NUM_TASKS] proctype Task() {
  byte task = _pid - 3;  // Nature is 0, Memory 1, Initial 2.
  byte turn, seen, heir, began;
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
  byte task = _pid - 2;  // After Task.
  byte seen, heir;
  bool cleared;
  ready;
  Off(task);
  num_done++
}
#endif
