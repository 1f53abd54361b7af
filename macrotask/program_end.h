#pragma once

#include <atomic>
#include <string>

namespace macrotask {

// Internal: the library ends the program. Tasks may then still sleep on objects
// whose destructors run, which must not wait for them.
inline constinit std::atomic<bool> program_stops{false};

// Internal: prints `text` on stderr and ends the program by std::exit(), so
// that open files are written. If several tasks call it, the first one's text
// and exit code count.
[[noreturn]] void StopProgram(const std::string& text, int exit_code);

}  // namespace macrotask
