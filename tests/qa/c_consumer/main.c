/* Tasks, a lock, an event and a barrier, in C: handles are int or long. Returns
   0 if the tasks have done as they were told. */

#include <stdio.h>

#include "macrotask/cray.h"

enum { kNumTasks = 4 };

static int lock;
static long barrier;
static long event;
static long sum;

static void Work(long* seen, long number) {
  EVWAIT(&event);
  LOCKON(&lock);
  sum += number;
  LOCKOFF(&lock);
  BARSYNC(&barrier);
  *seen = sum;
}

int main(void) {
  long tca[kNumTasks][2];
  long seen[kNumTasks];
  TSKTUNE("MAXCPU", 2, "HOLDTIME", 50);
  LOCKASGN(&lock, 0);
  EVASGN(&event);
  BARASGN(&barrier, kNumTasks);
  for (long i = 0; i < kNumTasks; ++i) {
    tca[i][0] = 2;
    TSKSTART(tca[i], Work, &seen[i], i + 1);
  }
  EVPOST(&event);
  for (int i = 0; i < kNumTasks; ++i) TSKWAIT(tca[i]);
  for (int i = 0; i < kNumTasks; ++i) {
    if (seen[i] == 10) continue;
    fprintf(stderr, "task %d saw %ld: expected 10\n", i, seen[i]);
    return 1;
  }
  return 0;
}
