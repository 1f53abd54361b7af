#pragma once

#include <string>

namespace macrotask {

// Internal: whether the caller is the pthread by which the library ends the
// program. Tasks may sleep on objects whose destructors it runs, which must not
// wait for them.
inline constinit thread_local bool caller_stops_program = false;

// Internal: prints `text` on stderr and ends the program by std::exit(), so
// that open files are written. If several tasks call it, the first one's text
// and exit code count; if what std::exit() runs calls it, the program ends
// there.
[[noreturn]] void StopProgram(const std::string& text, int exit_code);

}  // namespace macrotask
