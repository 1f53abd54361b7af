#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "macrotask/wait_policy.h"

namespace macrotask::cray {

// How tasks wait for what is assigned and started now: HOLDTIME of TSKTUNE, or
// the environment variable MACROTASK_WAIT.
WaitPolicy TunedPolicy();

struct TuningPair {
  std::string keyword;
  std::int64_t value;
};

// TSKTUNE. Checks all pairs before the first has an effect. Throws
// std::runtime_error on an unknown keyword or a value out of range.
void Tune(const std::vector<TuningPair>& pairs);

// BUFTUNE. Throws likewise.
void TuneTrace(std::string_view keyword, std::string_view value);

// BUFDUMP.
void DumpTrace();

}  // namespace macrotask::cray
