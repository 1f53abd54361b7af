/* The Cray macrotasking library for C, and for C++ programs written in it.

   As on UNICOS: upper-case names, handles by address. A handle is a variable of
   the caller, int or long (macrotask/cray_widths.h chooses by its type); it holds a small number, never a pointer. A variable may be assigned,
   released and assigned again.

   A wrong handle, an unknown keyword or a bad value ends the program: one
   sentence on stderr that names the routine, the task and the place of the
   call, then exit code 2. If no task can run any more: TSKLIST, the circle in
   which the tasks wait, "Deadlock - All user tasks waiting for locks, events,
   or tasks", exit code 3. Neither loses what the program has written.

   How tasks wait: TSKTUNE("HOLDTIME", us), or the environment variable
   MACROTASK_WAIT=block|spin|hold. MACROTASK_TRACE=FILE records a history trace
   without a change in the program. */

#pragma once

#ifdef __cplusplus
extern "C" {
#endif

/* A routine that runs as a task, of any arguments: the macro TSKSTART, and in
   C++ its overloads, convert it. */
typedef void macrotask_routine(void);

/* ---- Tasks ------------------------------------------------------------- */

/* Starts task(words...) as a task. tca is the task control array: word 0 its
   length in words, 2, or 3 with a user value; word 1 the number of the task,
   written here, garbage before is normal; word 2 the user value. The array may
   be used again for another task. Up to 20 words follow, integers and
   addresses, and arrive as they are; a double must be passed by address. */
void TSKSTART(long* tca, macrotask_routine* task, ...);

/* Returns when the task has completed, at once if it never existed or is
   complete. Several tasks may wait for one; twice is fine. */
void TSKWAIT(long* tca);

/* 1 if the task exists and is not complete, else 0. */
int TSKTEST(long* tca);

/* The user value of the calling task; 0 in the initial task or when none was
   given. Legal before any TSKSTART. */
void TSKVALUE(long* value);

/* Prints a table of the tasks on stdout: number, user value in hexadecimal and
   as text, state, and what each waits for. */
void TSKLIST(void);

/* Pairs of a keyword and a value, to be ended by a null pointer, which the
   macro adds. All pairs are checked before the first has an effect.
     MAXCPU    most processors that tasks run on
     HOLDTIME  microseconds for which a task that waits holds its processor,
               spinning, before it sleeps; 0: it sleeps at once. For what is
               assigned and started from now on
     STACKSZ   stack of a task in words of 8 bytes; 0: the system's default
     DBRELEAS, DBACTIVE, SAMPLE  taken, listed in the trace, without effect:
               every task has a pthread, there is nothing to be scheduled */
void TSKTUNE(const char* keyword, long value, ...);

/* ---- Locks ------------------------------------------------------------- */

/* Assigns a lock, clear. On an assigned lock: clears it; an error if tasks wait
   for it. */
void LOCKASGN(long* lock);

/* The same, only if *lock still equals value, so that tasks may race to it;
   LOCKASGN(lock, value) is this. */
void LOCKASGN_IF(long* lock, long value);

/* Returns when the caller holds the lock; first come, first served. */
void LOCKON(long* lock);

/* Clears the lock, or hands it to the first that waits. Any task may do it. */
void LOCKOFF(long* lock);

/* 1 if the lock was set already; 0: the caller now holds it. */
int LOCKTEST(long* lock);

/* Releases the lock; an error if it is set. */
void LOCKREL(long* lock);

/* ---- Events ------------------------------------------------------------ */

/* Assigns an event, cleared. On an assigned event: clears it. */
void EVASGN(long* event);

/* The same, only if *event still equals value; EVASGN(event, value) is this. */
void EVASGN_IF(long* event, long value);

/* Posts the event: all that wait go on, and nobody waits until EVCLEAR. */
void EVPOST(long* event);

/* Returns when the event is posted; never clears it. */
void EVWAIT(long* event);

/* Clears the event. */
void EVCLEAR(long* event);

/* 1 if the event is posted, else 0. */
int EVTEST(long* event);

/* Releases the event; an error if tasks wait for it. */
void EVREL(long* event);

/* ---- Barriers ---------------------------------------------------------- */

/* Assigns a barrier of num_tasks tasks, 1 or more. On an assigned barrier: a
   new one; an error if tasks wait at it. */
void BARASGN(long* barrier, long num_tasks);

/* Returns when num_tasks tasks have called it; at once ready for the next
   time. */
void BARSYNC(long* barrier);

/* Releases the barrier; an error if tasks wait at it. */
void BARREL(long* barrier);

/* ---- History trace ----------------------------------------------------- */

/* One keyword and its value.
     DN      name of the file for BUFDUMP, also written at the end of the
             program. Switches all classes on if none is
     TASKS, LOCKS, EVENTS, CPUS, USERS, INFO  ON or OFF; barriers are EVENTS
     SIZE    number of records of each task's buffer (ours, not Cray's) */
void BUFTUNE(const char* keyword, const char* value);

/* Writes an entry of the program's own: action 65 to 128. */
void BUFUSER(long action, long data);

/* Prints the trace on stdout, a line an entry, in the order of time. */
void BUFPRINT(void);

/* Writes the trace to the file named by DN, else to macrotask.trace. */
void BUFDUMP(void);

/* ---- Times ------------------------------------------------------------- */

/* CPU seconds of the calling task. */
double TSECND(void);

/* Prints on stdout how long 0, 1, 2, ... processors were busy, and the average
   concurrency. */
void MTTIMES(void);

#ifdef __cplusplus
} /* extern "C" */
#endif

#include "macrotask/cray_widths.h"
