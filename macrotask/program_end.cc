#include "macrotask/program_end.h"

#include <unistd.h>

#include <atomic>
#include <cstdio>
#include <cstdlib>

namespace macrotask {
namespace {

std::atomic<bool> stops{false};
int first_exit_code = 0;  // written before stops is seen by its own pthread

}  // namespace

void StopProgram(const std::string& text, int exit_code) {
  if (caller_stops_program) {
    std::fflush(nullptr);
    std::_Exit(first_exit_code);
  }
  if (stops.exchange(true)) {
    for (;;) pause();
  }
  caller_stops_program = true;
  first_exit_code = exit_code;
  // What the program has printed comes before what we say of it.
  std::fflush(stdout);
  std::fputs(text.c_str(), stderr);
  std::fflush(stderr);
  std::exit(exit_code);
}

}  // namespace macrotask
