#include "bench/sync_team.h"

#include <sched.h>

#include <memory>
#include <string_view>
#include <vector>

#include "macrotask/placement.h"
#include "macrotask/task.h"

namespace bench {
namespace {

// As RunTasks(), but nobody is pinned.
void RunFree(int num_tasks, macrotask::WaitPolicy wait,
             const std::function<void(int)>& body) {
  std::vector<std::unique_ptr<macrotask::Task>> others;
  for (int task = 1; task < num_tasks; ++task) {
    others.push_back(std::make_unique<macrotask::Task>(
        [&body, task] { body(task); }, macrotask::TaskOptions{.wait = wait}));
  }
  body(0);
  for (const auto& task : others) task->Wait();
}

}  // namespace

std::string_view Name(SyncPlacement placement) {
  return placement == SyncPlacement::kPinned ? "pinned" : "free";
}

Team MakeTaskTeam(int num_tasks, macrotask::WaitPolicy wait,
                  SyncPlacement placement) {
  if (placement == SyncPlacement::kFree) {
    return {num_tasks,
            [=](const std::function<void(int)>& body) {
              RunFree(num_tasks, wait, body);
            },
            wait};
  }
  return {num_tasks,
          [=](const std::function<void(int)>& body) {
            macrotask::RunTasks(num_tasks, body, wait);
          },
          wait};
}

Team MakePthreadTeam(int num_tasks, SyncPlacement placement) {
  Team team = MakeTaskTeam(num_tasks,
                           num_tasks <= macrotask::NumProcessors()
                               ? macrotask::WaitPolicy::Hold()
                               : macrotask::WaitPolicy::Block(),
                           placement);
  team.line.reset();
  return team;
}

StartLine::StartLine(const Team& team) : num_tasks_(team.num_tasks) {
  if (team.line) barrier_.emplace(num_tasks_, *team.line);
}

void StartLine::Wait() {
  if (barrier_) return barrier_->Sync();
  num_there_.fetch_add(1, std::memory_order_acq_rel);
  while (num_there_.load(std::memory_order_acquire) < num_tasks_) sched_yield();
}

}  // namespace bench
