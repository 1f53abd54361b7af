#pragma once

#include <exception>
#include <string>

namespace macrotask::cray {

// Internal: exit code of a program that a bad call ends.
inline constexpr int kBadCallExitCode = 2;

// Internal: which routine was called, and from where.
struct Call {
  const char* routine;
  const void* return_address;
};

// Internal: ends the program with the one sentence
// "macrotask: ROUTINE (task 3, at program+0x11a9): what".
[[noreturn]] void FailCall(const Call& call, const std::string& what);

// Internal: runs `body()`, the whole of a routine that C or Fortran calls.
template <typename Body>
auto RunCall(const Call& call, const Body& body) {
  try {
    return body();
  } catch (const std::exception& error) {
    FailCall(call, error.what());
  }
}

// Internal: the call in whose body this stands.
#define MACROTASK_CALL(routine) \
  ::macrotask::cray::Call { routine, __builtin_return_address(0) }

// Internal: for a routine that cannot know how many words it was given, and
// looks at more: those are its caller's variables, which other tasks may be
// writing. Nobody reads what was not given.
#define MACROTASK_LOOKS_AT_MORE_WORDS \
  __attribute__((no_sanitize_address, no_sanitize_thread))

}  // namespace macrotask::cray
