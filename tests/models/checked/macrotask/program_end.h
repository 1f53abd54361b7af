#pragma once

// In place of macrotask/program_end.h.

#include <string>

namespace macrotask {

void StopProgram(const std::string& text, int exit_code);

}  // namespace macrotask
