// DisseminationBarrier, macrotask/dissemination_barrier.cc: NUM_TASKS members
// go through NUM_PHASES phases. Its flags are what epoch.pml proves of Epoch:
// numbers for which one may wait, and sleep, until they are past what one has
// seen. ANONYMOUS=1: every other phase is one of Sync() without a member, on
// what counting_barrier.pml proves of CountingBarrier.
//
// Proved: nobody leaves phase k before all have arrived in it (assertion);
// nobody waits for ever (no state in which all that remain are blocked); Epoch
// is asked for nothing that it does not promise (assertions).
//
// proves NUM_TASKS=2 NUM_PHASES=6
// proves NUM_TASKS=3 NUM_PHASES=4
// proves NUM_TASKS=4 NUM_PHASES=3
// proves NUM_TASKS=5 NUM_PHASES=2
// proves NUM_TASKS=2 NUM_PHASES=6 ANONYMOUS=1
// proves NUM_TASKS=3 NUM_PHASES=4 ANONYMOUS=1
// finds BUG=WRONG_PARTNER NUM_TASKS=4 NUM_PHASES=1
// finds BUG=SAME_DISTANCE NUM_TASKS=4 NUM_PHASES=1
// finds BUG=ROUND_MISSING NUM_TASKS=3 NUM_PHASES=1
// finds BUG=ONE_FLAG NUM_TASKS=4 NUM_PHASES=2
// finds BUG=RESET NUM_TASKS=2 NUM_PHASES=3
// finds BUG=EQUAL NUM_TASKS=2 NUM_PHASES=2
// finds BUG=LOOK_FIRST NUM_TASKS=2 NUM_PHASES=1
//
// A comment "source: text" says which text of macrotask/source the line models.

#define WRONG_PARTNER 1  // waits for whom it tells, not for whoever tells it
#define SAME_DISTANCE 2  // tells the next member in every round
#define ROUND_MISSING 3  // floor(log2) rounds
#define ONE_FLAG 4       // the same flag in all rounds
#define RESET 5          // a flag that is set, and reset by whoever waited
#define EQUAL 6
#define LOOK_FIRST 7     // waits before it tells

// dissemination_barrier.cc:
//     num_rounds_(std::bit_width(static_cast<unsigned>(num_tasks - 1))),
#if NUM_TASKS <= 2
#define EXACT_ROUNDS 1
#elif NUM_TASKS <= 4
#define EXACT_ROUNDS 2
#else
#define EXACT_ROUNDS 3
#endif

#if BUG == ROUND_MISSING
#define NUM_ROUNDS (EXACT_ROUNDS - 1)
#else
#define NUM_ROUNDS EXACT_ROUNDS
#endif

#if BUG == ONE_FLAG
#define FLAG(member, round) flags[(member) * NUM_ROUNDS]
#else
// dissemination_barrier.h:
//     flags_[static_cast<std::size_t>(member * num_rounds_ + round)];
#define FLAG(member, round) flags[(member) * NUM_ROUNDS + (round)]
#endif

byte flags[NUM_TASKS * EXACT_ROUNDS];
byte arrivals;  // of CountingBarrier

byte phase_of[NUM_TASKS];  // in which a task has arrived, from 1; no part of it

inline Tell() {
#if BUG == RESET
  FLAG(partner, round) = 1
#elif BUG == ONE_FLAG
  FLAG(partner, round) = phase
#else
  atomic {
    assert(FLAG(partner, round) == phase - 1);  // one advancer
    // dissemination_barrier.cc: flag(partner, round).AdvanceTo(phase);
    FLAG(partner, round) = phase
  }
#endif
}

inline Await() {
#if BUG == RESET
  FLAG(member, round) == 1; FLAG(member, round) = 0
#elif BUG == EQUAL
  FLAG(member, round) == phase
#elif BUG == WRONG_PARTNER
  FLAG(partner, round) > phase - 1
#else
  assert(FLAG(member, round) >= phase - 1);  // epoch.h: `seen` <= Read()
  // dissemination_barrier.cc:
  //     flag(member, round).AwaitPast(phase - 1, policy_, waited_);
  FLAG(member, round) > phase - 1
#endif
}

inline SyncMember() {
  // dissemination_barrier.cc: phase =
  //     ++phases_[static_cast<std::size_t>(member)].arrived;
  atomic { phase++; phase_of[member]++ }
  // dissemination_barrier.cc: int partner = member + 1;
  partner = member + 1;
  round = 0;
  do
  // dissemination_barrier.cc: for (int round = 0; round < num_rounds_; ++round)
  :: round < NUM_ROUNDS ->
     // dissemination_barrier.cc: if (partner >= num_tasks_) partner -=
     //     num_tasks_;
     partner = partner % NUM_TASKS;
#if BUG == LOOK_FIRST
     Await(); Tell();
#else
     Tell(); Await();
#endif
#if BUG != SAME_DISTANCE
     // dissemination_barrier.cc: partner += 1 << round;
     partner = partner + (1 << round);
#endif
     round++
  :: else -> break
  od
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
  byte phase, partner, round, end_of_phase, all, other;
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
       other = 0; partner = 0; round = 0; end_of_phase = 0
     }
  :: else -> break
  od
}
