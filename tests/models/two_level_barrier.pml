// TwoLevelBarrier, macrotask/two_level_barrier.cc: NUM_TASKS tasks go through
// NUM_PHASES phases. The first GROUP_SIZE of them share a processor, the next
// GROUP_SIZE the next one, and the last NUM_UNPLACED are not placed. With
// PLACES=ANY a task is placed anew, or not placed, before each phase.
//
// Whether a task is alone on its processor is a hint that may be wrong at any
// time: any placed task may watch, several may at once, or none, and one that
// watches may give up at any moment. As every policy has it, a waiting task
// spins for as long as it takes, or sleeps.
//
// Proved: nobody leaves phase k before all have arrived in it (assertion), and
// nobody waits for ever (no state in which all that remain are blocked).
//
// proves NUM_TASKS=2 GROUP_SIZE=2 NUM_PHASES=4
// proves NUM_TASKS=2 GROUP_SIZE=1 NUM_PHASES=4
// proves NUM_TASKS=2 PLACES=ANY NUM_PHASES=3
// proves NUM_TASKS=3 GROUP_SIZE=2 NUM_PHASES=2 MAX_STRAY_WAKES=0
// proves NUM_TASKS=3 GROUP_SIZE=3 NUM_PHASES=2 MAX_STRAY_WAKES=0
// proves NUM_TASKS=3 GROUP_SIZE=2 NUM_UNPLACED=1 NUM_PHASES=2
// proves NUM_TASKS=4 GROUP_SIZE=2 NUM_PHASES=1 MAX_STRAY_WAKES=0
// finds BUG=COUNTED_ONCE NUM_TASKS=3 GROUP_SIZE=2 NUM_PHASES=2
// finds BUG=BOOL_MARK NUM_TASKS=3 GROUP_SIZE=2 NUM_PHASES=2 MAX_STRAY_WAKES=0
// finds BUG=ERASE_AFTER_ASKING NUM_TASKS=3 GROUP_SIZE=2 NUM_PHASES=2
// finds BUG=ERASE_NOTHING NUM_TASKS=2 GROUP_SIZE=1 NUM_PHASES=2
// finds BUG=WAKE_NOBODY NUM_TASKS=3 GROUP_SIZE=2 NUM_PHASES=2
// finds BUG=COUNT_THEN_READ NUM_TASKS=3 GROUP_SIZE=2 NUM_PHASES=2
// finds BUG=NUMBER_THEN_COUNT NUM_TASKS=3 GROUP_SIZE=2 NUM_PHASES=2
// finds BUG=ASK_THEN_COUNT NUM_TASKS=3 GROUP_SIZE=2 NUM_PHASES=2
// finds BUG=UNCOUNT_UNSEEN NUM_TASKS=3 GROUP_SIZE=2 NUM_PHASES=2
// finds BUG=FORGET_OWN NUM_TASKS=2 GROUP_SIZE=2 NUM_PHASES=2
// finds BUG=NO_COMPARE NUM_TASKS=2 GROUP_SIZE=2 NUM_PHASES=2
//
// A comment "source: text" says which text of macrotask/source the line models.

#define COUNTED_ONCE 1
#define BOOL_MARK 2
#define ERASE_AFTER_ASKING 3
#define ERASE_NOTHING 4
#define WAKE_NOBODY 5
#define COUNT_THEN_READ 6
#define NUMBER_THEN_COUNT 7
#define ASK_THEN_COUNT 8
#define UNCOUNT_UNSEEN 9
#define FORGET_OWN 10
#define NO_COMPARE 11

#define ANY 1

#ifndef NUM_UNPLACED
#define NUM_UNPLACED 0
#endif
#ifndef GROUP_SIZE
#define GROUP_SIZE 1
#endif

#define NUM_PLACED (NUM_TASKS - NUM_UNPLACED)
#if PLACES == ANY
#define NUM_GROUPS 3
#else
#define NUM_GROUPS ((NUM_PLACED + GROUP_SIZE - 1) / GROUP_SIZE + 1)
#endif
// two_level_barrier.cc: Group& group = groups_[shared != nullptr ?
//     shared->index : num_groups_ - 1];
#define UNPLACED (NUM_GROUPS - 1)

byte arrivals;
byte watched[NUM_GROUPS];
// The two halves of sleepers, read and written together.
byte num_asleep[NUM_GROUPS];
byte wake_ups[NUM_GROUPS];

byte in_futex[NUM_GROUPS];  // bit of every task that the system lets sleep

// No part of it: in which phase a task has arrived, from 1, and how many of a
// group know the number of its wake-ups. When nobody does, it may as well start
// from 0 again, which makes for fewer states.
byte phase_of[NUM_TASKS];
byte num_knowing[NUM_GROUPS];

#define BIT_OF(task) (1 << (task))

#if BUG == BOOL_MARK
#define MARK 1
#else
#define MARK end_of_phase
#endif

// two_level_barrier.cc: return arrivals_.load(std::memory_order_seq_cst) >=
//     end_of_phase;
#define IS_COMPLETE (arrivals >= end_of_phase)

// The system may wake a sleeper for no reason. A few times at most, and perhaps
// not at all: that a sleeper is lost must not be hidden by a promise that it
// will wake up by itself one day.
#ifndef MAX_STRAY_WAKES
#define MAX_STRAY_WAKES 1
#endif
active proctype Nature() {
  byte times;
  byte g, task;
  do
  :: times < MAX_STRAY_WAKES ->
     atomic {
       select(g : 0 .. NUM_GROUPS - 1);
       select(task : 0 .. NUM_TASKS - 1);
       in_futex[g] = in_futex[g] & ~BIT_OF(task);
       g = 0; task = 0;
       times++
     }
  :: break
  od
}

// Asks for the count and in the same step sets it, as often as the source may
// have to try.
inline WakeSleepers(g) {
  atomic {
    // two_level_barrier.cc: if (NumAsleep(sleepers) == 0) return; } while
    //     (!group.sleepers.compare_exchange_weak( sleepers, WakeUps(sleepers) +
    //     1, std::memory_order_seq_cst));
    if
    :: num_asleep[g] != 0 ->
       wakes = true;
       wake_ups[g]++;
#if BUG != NUMBER_THEN_COUNT
       num_asleep[g] = 0
#endif
    :: else
    fi
  }
  if
  :: wakes ->
#if BUG == NUMBER_THEN_COUNT
     num_asleep[g] = 0;
#endif
     // two_level_barrier.cc: FutexWakeAll(group.sleepers);
     atomic { in_futex[g] = 0; wakes = false }
  :: else
  fi
}

inline Release() {
  do
  :: i < NUM_GROUPS ->
     if
     // two_level_barrier.cc: if (&group == &own) continue;
     // two_level_barrier.cc: if (group.watched.load(std::memory_order_seq_cst)
     //     != end_of_phase) {
     :: i != group && watched[i] != MARK -> WakeSleepers(i)
     :: else
     fi;
     i++
  :: else -> i = 0; break
  od;
#if BUG != FORGET_OWN
  // two_level_barrier.cc: WakeSleepers(groups_[&own - groups_.get()]);
  WakeSleepers(group)
#endif
}

inline CountItself() {
  // two_level_barrier.cc: group.sleepers.fetch_add(kOneAsleep,
  //     std::memory_order_seq_cst) + kOneAsleep; const std::uint32_t wake_ups =
  //     WakeUps(sleepers);
#if BUG == COUNT_THEN_READ
  num_asleep[group]++;
  seen = wake_ups[group];
#elif BUG == COUNTED_ONCE
  atomic {
    num_asleep[group] = num_asleep[group] + (is_counted -> 0 : 1);
    is_counted = true;
    seen = wake_ups[group]
  };
#else
  atomic { num_asleep[group]++; seen = wake_ups[group] };
#endif
}

// The system lets the task sleep if the number is still the same.
inline FutexWait(task) {
  atomic {
    if
#if BUG == NO_COMPARE
    :: true -> in_futex[group] = in_futex[group] | BIT_OF(task)
#else
    :: wake_ups[group] == seen ->
       in_futex[group] = in_futex[group] | BIT_OF(task)
    :: else
#endif
    fi
  }
  !(in_futex[group] & BIT_OF(task))
}

inline SleepUntil(task) {
  do
  ::
#if BUG == ASK_THEN_COUNT
     is_complete = IS_COMPLETE;
     CountItself();
#else
     CountItself();
#endif
     do
#if BUG == ASK_THEN_COUNT
     :: is_complete ->
#else
     :: IS_COMPLETE ->
#endif
        // two_level_barrier.cc: } else if
        //     (group.sleepers.compare_exchange_weak( sleepers, sleepers -
        //     kOneAsleep, std::memory_order_seq_cst)) { return;
        atomic {
          if
#if BUG == UNCOUNT_UNSEEN
          :: true -> num_asleep[group]--
#else
          :: wake_ups[group] == seen -> num_asleep[group]--
          :: else
#endif
          fi
        }
        break
     // two_level_barrier.cc: if (!IsComplete(end_of_phase)) {
     //     FutexWait(group.sleepers, wake_ups); sleepers =
     //     group.sleepers.load(std::memory_order_seq_cst);
     :: else ->
#if BUG == ERASE_AFTER_ASKING
        if
        :: watches -> watched[group] = 0
        :: else
        fi;
#endif
        FutexWait(task);
        if
        // two_level_barrier.cc: while (WakeUps(sleepers) == wake_ups) {
        :: wake_ups[group] != seen -> break
        :: else
        fi
     od;
     if
     // two_level_barrier.cc: if (IsComplete(end_of_phase)) return;
     :: IS_COMPLETE -> break
     :: else
     fi
  od;
  atomic {
    seen = 0;
    num_knowing[group]--;
    if
    :: num_knowing[group] == 0 -> wake_ups[group] = 0
    :: else
    fi
  }
}

inline Sync(task) {
  atomic {
#if PLACES == ANY
    select(group : 0 .. UNPLACED);
#endif
    // two_level_barrier.cc: (arrivals_.load(std::memory_order_relaxed) /
    //     num_tasks_ + 1) * num_tasks_;
    end_of_phase = (arrivals / NUM_TASKS + 1) * NUM_TASKS;
    if
    // two_level_barrier.cc: if (watches) group.watched.store(end_of_phase,
    //     std::memory_order_seq_cst);
    :: group != UNPLACED -> watches = true; watched[group] = MARK
    :: true
    fi
  }
  atomic {
    assert(end_of_phase == (arrivals / NUM_TASKS + 1) * NUM_TASKS);
    // two_level_barrier.cc: arrivals_.fetch_add(1, std::memory_order_seq_cst);
    arrivals++;
    phase_of[task]++;
    is_last = (arrivals == end_of_phase)
  }
  if
  // two_level_barrier.cc: if (arrivals + 1 == end_of_phase) return
  //     Release(group, end_of_phase);
  :: is_last -> Release()
  :: else ->
     if
     :: true -> IS_COMPLETE  // It spins for as long as it takes.
     :: true ->
        atomic {
          num_knowing[group]++;
          if
#if BUG != ERASE_NOTHING && BUG != ERASE_AFTER_ASKING
          // two_level_barrier.cc: group.watched.store(0,
          //     std::memory_order_seq_cst); SleepUntil(group, end_of_phase);
          :: watches -> watched[group] = 0
#endif
          :: else
          fi
        }
        SleepUntil(task)
     fi;
     if
     // two_level_barrier.cc: }, [&] { return !shared->IsAlone(); });
     //     WakeSleepers(group);
#if BUG != WAKE_NOBODY
     :: watches -> WakeSleepers(group)
#endif
     :: else
     fi
  fi;
#if BUG == BOOL_MARK
  if
  :: watches -> watched[group] = 0
  :: else
  fi;
#endif
  watches = false; is_last = false; end_of_phase = 0
}

active [NUM_TASKS] proctype Task() {
  byte task = _pid - 1;  // Nature is 0.
  byte group = (task < NUM_PLACED -> task / GROUP_SIZE : UNPLACED);
  byte seen, end_of_phase, phase, i;
  bool watches, wakes, is_last;
#if BUG == COUNTED_ONCE
  bool is_counted;
#elif BUG == ASK_THEN_COUNT
  bool is_complete;
#endif
  do
  :: phase < NUM_PHASES ->
     Sync(task);
     d_step {
#if BUG == COUNTED_ONCE
       is_counted = false;
#endif
       phase++;
       do
       :: i < NUM_TASKS ->
          assert(phase_of[i] == phase || phase_of[i] == phase + 1);
          i++
       :: else -> break
       od;
       i = 0
     }
  :: else -> break
  od
}
