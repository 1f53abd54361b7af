/* The C interface from C11: a program of the kind that clients write. Returns
   the number of the first check that fails, 0 if none does. */

#include <stdio.h>
#include <stdlib.h>

#include "macrotask/cray.h"

#define CHECK(condition)                                          \
  do {                                                            \
    if (!(condition)) {                                           \
      fprintf(stderr, "line %d: not %s\n", __LINE__, #condition); \
      exit(1);                                                    \
    }                                                             \
  } while (0)

enum { kNumTasks = 4, kNumRounds = 500 };

/* Handles of the default width of the caller: int in one program, long in
   another. */
static int lock_32, event_32, barrier_32;
static long lock, event, barrier;

static long total, phases[kNumTasks];

static void AddUnderLocks(long addend, int *num_rounds) {
  for (int round = 0; round < *num_rounds; ++round) {
    LOCKON(&lock);
    LOCKON(&lock_32);
    total += addend;
    LOCKOFF(&lock_32);
    LOCKOFF(&lock);
  }
}

static void TestLocks(void) {
  long tcas[kNumTasks][2];
  int num_rounds = kNumRounds;
  LOCKASGN(&lock);
  LOCKASGN(&lock_32);
  for (int i = 0; i < kNumTasks; ++i) {
    tcas[i][0] = 2;
    TSKSTART(tcas[i], AddUnderLocks, 3L, &num_rounds);
  }
  for (int i = 0; i < kNumTasks; ++i) TSKWAIT(tcas[i]);
  CHECK(total == 3L * kNumTasks * kNumRounds);
  CHECK(LOCKTEST(&lock) == 0);
  CHECK(LOCKTEST(&lock) == 1);
  LOCKOFF(&lock);
  LOCKREL(&lock);
  LOCKREL(&lock_32);
}

/* The second argument: only if the variable still has that value. */
static void TestOptionalArguments(void) {
  int other_32 = -1;
  long other = -1;
  LOCKASGN(&other_32, 0);
  LOCKASGN(&other, 0L);
  CHECK(other_32 == -1 && other == -1);
  LOCKASGN(&other_32, -1);
  LOCKASGN(&other, -1L);
  CHECK(other_32 > 0 && other > 0);
  LOCKREL(&other_32);
  LOCKREL(&other);
  other_32 = 0;
  other = 0;
  EVASGN(&other_32, 1);
  EVASGN(&other, 1L);
  CHECK(other_32 == 0 && other == 0);
  EVASGN(&other_32, 0);
  EVASGN(&other, 0L);
  CHECK(EVTEST(&other_32) == 0 && EVTEST(&other) == 0);
  EVREL(&other_32);
  EVREL(&other);
}

static void Phases(long task) {
  for (long phase = 1; phase <= kNumRounds; ++phase) {
    phases[task] = phase;
    BARSYNC(&barrier);
    for (int i = 0; i < kNumTasks; ++i) CHECK(phases[i] == phase);
    BARSYNC(&barrier_32);
  }
}

static void TestBarriers(void) {
  int tcas[kNumTasks][2];
  BARASGN(&barrier, kNumTasks);
  BARASGN(&barrier_32, kNumTasks);
  for (long i = 0; i < kNumTasks; ++i) {
    tcas[i][0] = 2;
    TSKSTART(tcas[i], Phases, i);
  }
  for (int i = 0; i < kNumTasks; ++i) TSKWAIT(tcas[i]);
  BARREL(&barrier);
  BARREL(&barrier_32);
}

static void Answer(void) {
  long value = 0;
  EVWAIT(&event);
  TSKVALUE(&value);
  total = value;
  EVPOST(&event_32);
}

static void TestEventsAndValues(void) {
  int tca[3] = {3, 0, 4711}, value = 1;
  EVASGN(&event);
  EVASGN(&event_32);
  TSKSTART(tca, Answer);
  CHECK(TSKTEST(tca) == 1);
  EVPOST(&event);
  EVWAIT(&event_32);
  CHECK(total == 4711);
  CHECK(EVTEST(&event_32) == 1);
  EVCLEAR(&event_32);
  CHECK(EVTEST(&event_32) == 0);
  TSKWAIT(tca);
  CHECK(TSKTEST(tca) == 0);
  TSKVALUE(&value);
  CHECK(value == 0);
  EVREL(&event);
  EVREL(&event_32);
}

int main(void) {
  TSKTUNE("HOLDTIME", 20);
  TSKTUNE("MAXCPU", 64, "HOLDTIME", 50, "DBACTIVE", 1);
  BUFTUNE("USERS", "ON");
  BUFUSER(65, 1);
  TestLocks();
  TestOptionalArguments();
  TestBarriers();
  TestEventsAndValues();
  TSKLIST();
  MTTIMES();
  BUFPRINT();
  CHECK(TSECND() > 0);
  return 0;
}
