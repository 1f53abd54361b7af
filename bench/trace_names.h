#pragma once

#include <string>

#include "macrotask/trace_record.h"

namespace bench {

// What macrotask::ActionText() prints, of known actions. Throws
// std::invalid_argument, one sentence with the expected names.
macrotask::TraceAction ActionCalled(const std::string& text);

}  // namespace bench
