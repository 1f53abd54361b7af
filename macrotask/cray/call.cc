#include "macrotask/cray/call.h"

#include <dlfcn.h>
#include <link.h>

#include <cstdint>
#include <cstdio>

#include "macrotask/program_end.h"
#include "macrotask/task_registry.h"

namespace macrotask::cray {
namespace {

// As addr2line takes it: file and address in it, with the function if the file
// tells its name.
std::string Place(const void* return_address) {
  // The call itself, which may be the end of another line.
  const auto* const address = static_cast<const char*>(return_address) - 1;
  Dl_info info;
  const link_map* map = nullptr;
  if (dladdr1(address, &info,
              reinterpret_cast<void**>(const_cast<link_map**>(&map)),
              RTLD_DL_LINKMAP) == 0 ||
      info.dli_fname == nullptr) {
    return "?";
  }
  char offset[32];
  std::snprintf(offset, sizeof offset, "+0x%jx",
                static_cast<std::uintmax_t>(
                    reinterpret_cast<std::uintptr_t>(address) - map->l_addr));
  std::string place = info.dli_fname + std::string(offset);
  if (info.dli_sname != nullptr) {
    place += std::string(" in ") + info.dli_sname;
  }
  return place;
}

}  // namespace

void FailCall(const Call& call, const std::string& what) {
  StopProgram(std::string("macrotask: ") + call.routine + " (task " +
                  std::to_string(RecordOfCaller().number()) + ", at " +
                  Place(call.return_address) + "): " + what + "\n",
              kBadCallExitCode);
}

}  // namespace macrotask::cray
