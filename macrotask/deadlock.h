#pragma once

namespace macrotask {

// Exit code of a program that a deadlock stops.
inline constexpr int kDeadlockExitCode = 3;

// Whether the library looks for deadlocks (it does from the start). When no
// task can run, because each waits for a barrier, an event, a lock or a task
// and none of these waits is over, it prints the list of tasks, the circle in
// which they wait if there is one, and Cray's message, all on stderr, writes
// the history trace if one was asked for, and ends the program by
// std::exit(kDeadlockExitCode).
//
// Not seen: tasks that spin on Lock::Test(), Event::Test() or Task::Test(). No
// alarm as long as any task runs, sleeps in a system call of its own or is
// being started, or if the process has a pthread that has never waited in
// this library: it may yet do what the others wait for. A task that has gone to
// sleep for that reason does not look again.
//
// Use: any task, at any time.
// Cost: nothing for a wait that is over within half a microsecond; for a longer
// one two atomic stores and a look at the others (bench rows "BARSYNC" and
// "BARSYNC, no deadlock detection").
void SetDeadlockDetection(bool on);

// Internal: ends the program if no task can run. Called by a task that has
// begun to wait, before it sleeps and now and then while it spins, and by a
// pthread whose task has ended.
void DetectDeadlock();

}  // namespace macrotask
