#include "bench/machine.h"

#include <sys/utsname.h>

#include <fstream>

#include "bench/build_info.h"
#include "macrotask/placement.h"

namespace bench {
namespace {

std::string CpuModel() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);) {
    if (!line.starts_with("model name")) continue;
    const std::size_t colon = line.find(": ");
    if (colon != std::string::npos) return line.substr(colon + 2);
  }
  return "unknown";
}

std::string Kernel() {
  utsname name;
  if (uname(&name) != 0) return "unknown";
  return std::string(name.sysname) + " " + name.release + " " + name.machine;
}

}  // namespace

Machine DescribeMachine() {
  return {.cpu = CpuModel(),
          .processors = macrotask::NumProcessors(),
          .kernel = Kernel(),
          .compiler = kCompiler,
          .flags = kFlags,
          .version = kVersion,
          .git_hash = kGitHash};
}

}  // namespace bench
