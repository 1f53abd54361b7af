#include "macrotask/cray/call.h"

#include <dlfcn.h>

#include <cstdint>
#include <cstdio>

#include "macrotask/program_end.h"
#include "macrotask/task_registry.h"

namespace macrotask::cray {
namespace {

// As addr2line takes it: file and offset in it, with the function if the file
// tells its name.
std::string Place(const void* address) {
  Dl_info info;
  if (dladdr(address, &info) == 0 || info.dli_fname == nullptr) return "?";
  char offset[32];
  std::snprintf(
      offset, sizeof offset, "+0x%jx",
      static_cast<std::uintmax_t>(static_cast<const char*>(address) -
                                  static_cast<const char*>(info.dli_fbase)));
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
