#pragma once

#include <string>

namespace macrotask {

// Stands for "whichever processor the system chooses".
inline constexpr int kAnyProcessor = -1;

// Number of processors that this process was allowed to use when the library
// first asked (its affinity mask, not the machine), or the maximum set since.
// At least 1. Thread-safe.
int NumProcessors();

// Uses only the first `num_processors` of these from now on, for pthreads that
// start a task later and for the caller; fewer if there are fewer. Throws
// std::invalid_argument if `num_processors` < 1.
//
// Cray name: MAXCPU, a keyword of TSKTUNE.
void SetMaxProcessors(int num_processors);

// True iff `processor` is one of those NumProcessors() counts. Thread-safe.
bool IsUsable(int processor);

// Where the tasks of a RunTasks() go: one processor each, in ascending order of
// the affinity mask, if there are enough of them; otherwise as many or one more
// on each, neighbours together. An immutable value, so that it may be read by
// any task.
//
// Cray name: none; the paper's tasks had a processor each (TSKTUNE's MAXCPU).
// Cost: computed, not measured; it moves nobody.
//
//   Placement placement(num_tasks);
//   std::cout << placement.ToString() << '\n';
//   // 2 tasks pinned: task 0 on processor 0, task 1 on processor 1
class Placement {
 public:
  // Throws std::invalid_argument if `num_tasks` < 1.
  explicit Placement(int num_tasks);

  // True iff there are more tasks than processors.
  bool is_crowded() const { return num_tasks_ > num_processors_; }
  int num_tasks() const { return num_tasks_; }

  // Which of the processors that of `task` is, in [0, NumProcessors()); `task`
  // is in [0, num_tasks()).
  int index(int task) const;

  // The system's number of that processor.
  int processor(int task) const;

  // One line without a full stop, such as "16 tasks pinned: tasks 0 to 7 on
  // processor 0, tasks 8 to 15 on processor 1".
  std::string ToString() const;

 private:
  int num_tasks_;
  int num_processors_;
};

}  // namespace macrotask
