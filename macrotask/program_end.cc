#include "macrotask/program_end.h"

#include <unistd.h>

#include <cstdio>
#include <cstdlib>

namespace macrotask {

void StopProgram(const std::string& text, int exit_code) {
  if (program_stops.exchange(true)) {
    for (;;) pause();
  }
  // What the program has printed comes before what we say of it.
  std::fflush(stdout);
  std::fputs(text.c_str(), stderr);
  std::fflush(stderr);
  std::exit(exit_code);
}

}  // namespace macrotask
