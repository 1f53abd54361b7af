#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

#include "bench/predict/machine_file.h"
#include "macrotask/wait_policy.h"

// The shortest file that is a machine, and what is wrong with one that is none.

namespace bench::predict {

inline constexpr const char* kMinimal =
    R"({"format": "macrotask machine 1", "name": "m", "processors": 2,)"
    R"( "lanes": {"1": {}}, "conditions": [{"waits": {"hold": {}}}]})";

inline MachineModel MinimalMachine() {
  MachineModel machine;
  machine.name = "m";
  machine.processors = 2;
  machine.lanes[1] = {};
  machine.conditions.resize(1);
  machine.conditions[0].waits[macrotask::WaitKind::kHold] = {};
  return machine;
}

// "" if it is one.
inline std::string ErrorOf(std::string_view text) {
  try {
    ParseMachine(text, "m.json");
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

}  // namespace bench::predict
