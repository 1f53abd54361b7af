#include "bench/output_file.h"

#include <cerrno>
#include <cstdio>
#include <stdexcept>
#include <system_error>

#include "macrotask/whole_file.h"

namespace bench {

void WriteOutput(const std::string& path, const std::string& text) {
  if (path != "-") return macrotask::WriteWholeFile(path, text);
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() ||
      std::fflush(stdout) != 0) {
    throw std::runtime_error("cannot write the standard output: " +
                             std::generic_category().message(errno));
  }
}

void CheckOutput(const std::string& path) {
  if (path.empty()) throw std::runtime_error("the output file has no name");
  if (path != "-") macrotask::CheckWholeFile(path);
}

}  // namespace bench
