#pragma once

#include <string>
#include <string_view>

// Files that appear whole or not at all.

namespace macrotask {

// Writes `bytes` to the file `path`. An old file stays until the new one is
// complete: it is written beside it and renamed. A device or a pipe is written
// to; where the path is a link, the file itself is replaced. Throws
// std::runtime_error, one sentence with the path and the reason.
void WriteWholeFile(const std::string& path, std::string_view bytes);

// Throws as WriteWholeFile() would if `path` cannot be written. Leaves nothing
// behind.
void CheckWholeFile(const std::string& path);

// Throws likewise, of reading.
std::string ReadWholeFile(const std::string& path);

}  // namespace macrotask
