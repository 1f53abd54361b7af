#pragma once

// In place of macrotask/program_end.h.

#include <string>

namespace macrotask {

inline constexpr bool caller_stops_program = false;

void StopProgram(const std::string& text, int exit_code);

}  // namespace macrotask
