#include "bench/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

namespace bench {

Progress::Progress() : terminal_(isatty(STDERR_FILENO) == 1) {}

Progress::~Progress() {
  if (terminal_) fmt::print(stderr, "\r\033[K");
}

void Progress::Show(const std::string& what, int done, int all) {
  if (!terminal_) return;
  fmt::print(stderr, "\r\033[K{} {} %", what, 100 * done / all);
  std::fflush(stderr);
}

}  // namespace bench
