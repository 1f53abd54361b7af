#pragma once

#include <string>

namespace bench {

// Writes `text` to the file `path`, or to the standard output for "-". The file
// appears whole or not at all, and an old one stays until the new one is
// complete: it is written beside it and renamed. Throws std::runtime_error, one
// sentence with the path and the reason.
void WriteOutput(const std::string& path, const std::string& text);

// Throws as WriteOutput would if `path` cannot be written; to be asked before
// long work. Leaves nothing behind.
void CheckOutput(const std::string& path);

}  // namespace bench
