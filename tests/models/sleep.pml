// What tasks sleep on, as macrotask/mutex.h has it of POSIX: a mutex and a
// condition variable, for up to 8 tasks.

#define BIT_OF(task) (1 << (task))

bool mutex_is_locked;
byte asleep;  // bit of every task in the condition variable

inline LockMutex() { atomic { !mutex_is_locked -> mutex_is_locked = true } }

inline UnlockMutex() { mutex_is_locked = false }

// Falls asleep and unlocks in one step, and locks again after waking up.
inline WaitCondition(task) {
  atomic { asleep = asleep | BIT_OF(task); mutex_is_locked = false }
  atomic {
    !(asleep & BIT_OF(task)) && !mutex_is_locked -> mutex_is_locked = true
  }
}

inline WakeAll() { asleep = 0 }

// A condition variable may wake a sleeper for no reason. A few times at most,
// and perhaps not at all: that a sleeper is lost must not be hidden by a
// promise that it will wake up by itself one day.
#ifndef MAX_STRAY_WAKES
#define MAX_STRAY_WAKES 1
#endif
active proctype Nature() {
  byte times = 0;
  byte task;
  do
  :: times < MAX_STRAY_WAKES && asleep != 0 ->
     atomic {
       select(task : 0 .. 7);
       asleep = asleep & ~BIT_OF(task);
       times++
     }
  :: break
  od
}
