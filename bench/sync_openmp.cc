#include "bench/sync_openmp.h"

#include <dlfcn.h>

#include <filesystem>
#include <stdexcept>
#include <system_error>

#include "macrotask/affinity.h"
#include "macrotask/placement.h"

namespace bench {
namespace {

namespace fs = std::filesystem;

// Where the modules may be: installed, and in the build folder.
std::vector<fs::path> ModuleFolders() {
  std::vector<fs::path> folders;
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  if (!error) {
    folders.push_back(program.parent_path().parent_path() /
                      MACROTASK_MODULES_INSTALLED);
  }
  folders.emplace_back(MACROTASK_MODULES_BUILT);
  return folders;
}

// A module stays open: its threads may outlive all else. RTLD_LOCAL keeps the
// symbols of one runtime from those of the other.
void* OpenModule(const std::string& name) {
  for (const fs::path& folder : ModuleFolders()) {
    const fs::path path = folder / ("macrotask_" + name + ".so");
    if (void* const module = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL)) {
      return module;
    }
  }
  return nullptr;
}

struct PlacedBody {
  const std::function<void(int)>* body;
  const macrotask::Placement* placement;  // null: none
};

void RunPlaced(int task, void* context) {
  const auto* const placed = static_cast<const PlacedBody*>(context);
  const macrotask::ScopedProcessor on_own_processor(
      placed->placement == nullptr ? macrotask::kAnyProcessor
                                   : placed->placement->processor(task));
  (*placed->body)(task);
}

}  // namespace

std::shared_ptr<OpenMpRuntime> OpenMpRuntime::Open(const std::string& name) {
  void* const module = OpenModule(name);
  if (module == nullptr) return nullptr;
  const auto runtime = std::make_shared<OpenMpRuntime>();
  runtime->name_ = name;
  runtime->run_ = reinterpret_cast<Run>(dlsym(module, "macrotask_omp_run"));
  runtime->barrier_ =
      reinterpret_cast<void (*)()>(dlsym(module, "macrotask_omp_barrier"));
  const bool complete =
      runtime->run_ != nullptr && runtime->barrier_ != nullptr;
  return complete ? runtime : nullptr;
}

Team OpenMpRuntime::MakeTeam(int num_tasks, SyncPlacement placement) {
  return {num_tasks, [=, this](const std::function<void(int)>& body) {
            RunTeam(num_tasks, placement, body);
          }};
}

void OpenMpRuntime::RunTeam(int num_tasks, SyncPlacement placement,
                            const std::function<void(int)>& body) const {
  const macrotask::Placement own(num_tasks);
  PlacedBody placed = {&body,
                       placement == SyncPlacement::kPinned ? &own : nullptr};
  if (run_(num_tasks, &RunPlaced, &placed) == 0) {
    throw std::runtime_error(name_ + " gives fewer than " +
                             std::to_string(num_tasks) + " threads");
  }
}

}  // namespace bench
