#pragma once

#include <atomic>
#include <functional>
#include <optional>

#include "macrotask/barrier.h"
#include "macrotask/wait_policy.h"

namespace bench {

enum class SyncPlacement {
  kPinned,  // as RunTasks() does
  kFree,    // wherever the system puts them
};

std::string_view Name(SyncPlacement placement);

// Tasks that run a body together, all at once.
struct Team {
  int num_tasks;
  std::function<void(const std::function<void(int)>& body)> run;
  // How they wait at the start line: of macrotask's tasks as they always do (a
  // task that spins might keep the others of its pthread from starting),
  // otherwise by yielding.
  std::optional<macrotask::WaitPolicy> line = {};
};

// Tasks of the library that wait as `wait` says.
Team MakeTaskTeam(int num_tasks, macrotask::WaitPolicy wait,
                  SyncPlacement placement);

// Pthreads (of the library) for what others than the library do.
Team MakePthreadTeam(int num_tasks, SyncPlacement placement);

// Where the tasks of a team meet before they start, once.
class StartLine {
 public:
  explicit StartLine(const Team& team);

  void Wait();

 private:
  const int num_tasks_;
  std::optional<macrotask::Barrier> barrier_;
  std::atomic<int> num_there_{0};
};

}  // namespace bench
