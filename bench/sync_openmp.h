#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "bench/sync_team.h"

namespace bench {

// An OpenMP runtime in a module of its own, so that several of them, which all
// have the same symbols, can be in one process.
class OpenMpRuntime {
 public:
  // "libgomp" or "libomp". Null if this program was built without its module or
  // the runtime is not installed.
  static std::shared_ptr<OpenMpRuntime> Open(const std::string& name);

  // Threads of the runtime. The body may call Barrier(). Throws
  // std::runtime_error if the runtime gives too few.
  Team MakeTeam(int num_tasks, SyncPlacement placement);

  void Barrier() const { barrier_(); }

 private:
  using Body = void (*)(int task, void* context);
  using Run = int (*)(int num_tasks, Body body, void* context);

  void RunTeam(int num_tasks, SyncPlacement placement,
               const std::function<void(int)>& body) const;

  std::string name_;
  Run run_ = nullptr;
  void (*barrier_)() = nullptr;
};

inline constexpr const char* kOpenMpRuntimes[] = {"libgomp", "libomp"};

}  // namespace bench
