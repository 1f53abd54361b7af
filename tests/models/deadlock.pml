// How a wait is published and how a deadlock is found:
// macrotask/task_record.cc, deadlock.cc, and where worker_pool.cc,
// spin_then_sleep.h and published_wait.cc call them. Memory is sequentially
// consistent here, as the operations on the records are.
//
// The initial task starts NUM_TASKS others on NUM_WORKERS pthreads, waiting for
// one of them to end when all pthreads are busy, and then waits for all. Each
// task does NUM_ACTIONS things, any of these: post one of NUM_EVENTS events,
// wait for one, wait for the end of any task. What is over stays over, as the
// epochs of the library do.
//
// Proved: at an alarm no task runs, is in flight, or is in a wait that is over
// (assertion); when all wait for ever there is an alarm (no state in which all
// that remain are blocked); a wait that is examined lives (assertion).
//
// proves NUM_WORKERS=1 NUM_TASKS=2 NUM_ACTIONS=2 NUM_EVENTS=1
// proves NUM_WORKERS=2 NUM_TASKS=2 NUM_ACTIONS=2 NUM_EVENTS=1
// proves NUM_WORKERS=2 NUM_TASKS=2 NUM_ACTIONS=1 NUM_EVENTS=2
// proves NUM_WORKERS=2 NUM_TASKS=3 NUM_ACTIONS=1 NUM_EVENTS=1
// finds BUG=SINGLE_PASS NUM_WORKERS=2 NUM_TASKS=2 NUM_ACTIONS=2 NUM_EVENTS=1
// finds BUG=SEARCH_FIRST NUM_WORKERS=1 NUM_TASKS=1 NUM_ACTIONS=1 NUM_EVENTS=1
// finds BUG=IGNORE_OVER NUM_WORKERS=1 NUM_TASKS=1 NUM_ACTIONS=1 NUM_EVENTS=1
// finds BUG=NOT_READY NUM_WORKERS=1 NUM_TASKS=1 NUM_ACTIONS=1 NUM_EVENTS=1
// finds BUG=NO_NUMBER NUM_WORKERS=2 NUM_TASKS=2 NUM_ACTIONS=3 NUM_EVENTS=2
// finds BUG=LEAVE_AT_ONCE NUM_WORKERS=2 NUM_TASKS=2 NUM_ACTIONS=1 NUM_EVENTS=1
// finds BUG=STORE_COMPLETE NUM_WORKERS=1 NUM_TASKS=2 NUM_ACTIONS=1 NUM_EVENTS=1
//
// A comment "source: text" says which text of macrotask/source the line models.

#define SINGLE_PASS 1
#define SEARCH_FIRST 2
#define IGNORE_OVER 3
#define NOT_READY 4
#define NO_NUMBER 5
#define LEAVE_AT_ONCE 6
#define STORE_COMPLETE 7

// States, with the number of the wait above them.
#define NONE 0
#define READY 1
#define RUNNING 2
#define WAITING 3
#define EXAMINED 4
#define COMPLETE 5
#define STATE_OF(word) ((word) & 7)
#define CAN_RUN(word) (STATE_OF(word) == READY || STATE_OF(word) == RUNNING)
#if BUG == NO_NUMBER
#define NEXT_WAIT(word) (WAITING)
#else
#define NEXT_WAIT(word) (((word) & ~7) + 8 + WAITING)
#endif
#define WITH(word, state) (((word) & ~7) | state)

// One record a pthread; that of the initial task is 0.
#define NUM_RECORDS (NUM_WORKERS + 1)
byte word[NUM_RECORDS];
byte object[NUM_RECORDS];    // what_, wait_
byte given[NUM_RECORDS];     // 1 + the task that the worker shall run
bool is_idle[NUM_RECORDS];   // in the pool

// Whether a wait for an event, or for the end of a task, is over.
#define NUM_OBJECTS (NUM_EVENTS + NUM_TASKS)
bool is_over[NUM_OBJECTS];
#define END_OF(task) (NUM_EVENTS + (task))

// Of the search; guarded by ExamineMutex().
bool is_examining;
byte seen[NUM_RECORDS];

// No part of it: the truth about the task of a record.
#define MOVES 1
#define STANDS 2
byte truth[NUM_RECORDS];
bool wait_lives[NUM_RECORDS];
bool alarm;

inline DetectDeadlock() {
  // deadlock.cc: if (SomeTaskCanRun()) return;
  r = NUM_RECORDS;
  found = true;
  do
  :: found && r > 0 -> r--; found = !CAN_RUN(word[r])
  :: else -> break
  od;
  if
  :: found ->
     // deadlock.cc: const MutexGuard one_at_a_time(ExamineMutex());
     atomic { !is_examining -> is_examining = true }
     // The round before, without a list, is the same once more: left out.
     // deadlock.cc: if (!SeeAll(first) || HasUnknownPthread()
     r = NUM_RECORDS;
     do
     :: found && r > 0 ->
        r--;
        atomic {
          seen[r] = word[r];
          // deadlock.cc: if (CanRun(record->seen.state)) return false;
          found = !CAN_RUN(seen[r]);
#if BUG == SINGLE_PASS
          if
          :: STATE_OF(seen[r]) == WAITING -> found = !is_over[object[r]]
          :: else
          fi
#endif
        }
     :: else -> break
     od;
#if BUG != SINGLE_PASS
     // deadlock.cc: !ConfirmAll(first, &tasks)) {
     r = NUM_RECORDS;
     do
     :: found && r > 0 ->
        r--;
        if
        :: atomic {
             // task_record.h: if (!Exchange(word, examined)) return false;
             STATE_OF(seen[r]) == WAITING && word[r] == seen[r] ->
             word[r] = WITH(seen[r], EXAMINED)
           }
#if BUG != IGNORE_OVER
           // task_record.h: look(*what_, is_over_(wait_));
           atomic { assert(wait_lives[r]); found = !is_over[object[r]] };
#endif
           word[r] = seen[r]  // task_record.h: Exchange(examined, word);
        // deadlock.cc: if (all_over || (!waits && !(record->Read() == word)))
        //     return false;
        :: else -> found = (word[r] == seen[r])
        fi
     :: else -> break
     od;
#endif
     if
     :: found -> Alarm()
     :: else
     fi;
     d_step {
       r = NUM_RECORDS;
       do
       :: r > 0 -> r--; seen[r] = 0
       :: else -> break
       od;
       is_examining = false
     }
  :: else
  fi;
  atomic { r = 0; found = false }
}

inline Alarm() {
  d_step {
    r = NUM_RECORDS;
    do
    :: r > 0 ->
       r--;
       assert(truth[r] != MOVES);
       assert(truth[r] != STANDS || !is_over[object[r]])
    :: else -> break
    od;
    alarm = true
  }
}

// SpinThenSleep(): whoever spins looks for a deadlock now and then as well.
inline Wait(what) {
  if
  :: is_over[what]  // spin_then_sleep.h: if (done()) return;
  :: else ->
#if BUG == SEARCH_FIRST
     DetectDeadlock();
#endif
     atomic {
       object[me] = what;
       truth[me] = STANDS;
       wait_lives[me] = true;
       // task_record.cc: word_.store(Pack({Read().epoch + 1,
       //     TaskState::kWaiting}));
       word[me] = NEXT_WAIT(word[me])
     }
#if BUG != SEARCH_FIRST
     // published_wait.cc: RecordIf(TraceClass::kCpus, TraceAction::kSleep, 0);
     //     DetectDeadlock();
     DetectDeadlock();
#endif
     if
     // spin_then_sleep.h: wait.BeginSleep(); sleep(); wait.EndSleep();
     :: is_over[what]
     :: alarm -> goto end_of_program
     fi;
     atomic {
#if BUG != LEAVE_AT_ONCE
       // task_record.cc: !Exchange({epoch, TaskState::kWaiting}, {epoch,
       //     TaskState::kRunning})) {
       STATE_OF(word[me]) == WAITING ->
#endif
       truth[me] = MOVES;
       wait_lives[me] = false;
       word[me] = WITH(word[me], RUNNING)
     }
  fi
}

inline Act() {
  byte action;
  do
  :: action < NUM_ACTIONS ->
     if
     :: true -> select(what : 0 .. NUM_EVENTS - 1); is_over[what] = true
     :: true -> select(what : 0 .. NUM_OBJECTS - 1); Wait(what)
     :: break
     fi;
     what = 0;
     action++
  :: else -> break
  od;
  action = 0; what = 0
}

inline Start(task) {
  atomic {
    // worker_pool.cc: if (Worker* const idle = TakeIdle(processor)) return
    //     idle;
    if
    :: is_idle[1] -> what = 1
#if NUM_WORKERS > 1
    :: is_idle[2] -> what = 2
#endif
    fi;
    is_idle[what] = false
  }
#if BUG == NOT_READY
  truth[what] = MOVES;
#else
  atomic {
    truth[what] = MOVES;
    // task_record.cc: word_.store(Pack({EpochOf(number), TaskState::kReady}),
    word[what] = (task + 1) * 32 + READY
  }
#endif
  // worker_pool.cc: job_ = &job; given_.Advance();
  atomic { given[what] = task + 1; what = 0 }
}

active proctype Initial() {
  byte me = 0;
  byte r, what, task;
  bool found;
  d_step {
    is_idle[1] = true;
#if NUM_WORKERS > 1
    is_idle[2] = true;
#endif
    truth[0] = MOVES;
    word[0] = RUNNING
  }
  do
  :: task < NUM_TASKS ->
     if
     :: task >= NUM_WORKERS -> Wait(END_OF(task - NUM_WORKERS))
     :: else
     fi;
     Start(task);
     task++
  :: else -> break
  od;
  do
  :: task > 0 -> task--; Wait(END_OF(task))
  :: else -> break
  od;
end_of_program: skip
}

active [NUM_WORKERS] proctype Worker() {
  byte me = _pid;  // Initial is 0.
  byte r, what, task;
  bool found;
end_idle:
  do
  :: atomic { given[me] != 0 -> task = given[me] - 1; given[me] = 0 }
     // worker_pool.cc: record_->SetRunning(job.number);
     word[me] = (task + 1) * 32 + RUNNING;
     Act();
     is_idle[me] = true;  // worker_pool.cc: WorkerPool::TheOne().Return(this);
     atomic {
       // worker_pool.cc: job.done.Advance(); record_->SetComplete();
       //     DetectDeadlock();
       is_over[END_OF(task)] = true;
       if
       :: given[me] == 0 && STATE_OF(word[me]) != READY -> truth[me] = 0
       :: else
       fi
     }
#if BUG == STORE_COMPLETE
     if
     :: STATE_OF(word[me]) == RUNNING -> word[me] = WITH(word[me], COMPLETE)
     :: else
     fi;
#else
     atomic {
       if
       // task_record.cc: Exchange(now, {now.epoch, TaskState::kComplete});
       :: STATE_OF(word[me]) == RUNNING -> word[me] = WITH(word[me], COMPLETE)
       :: else
       fi
     }
#endif
     task = 0;
     DetectDeadlock()
  od;
end_of_program: skip
}
