#pragma once

#include <string>
#include <string_view>

#include "bench/predict/machine.h"

// Machines as files, JSON.
//
//   {
//     "format": "macrotask machine 1",
//     "name": "CRAY Y-MP8/864, UNICOS 6.0",
//     "source": "where the figures come from",
//     "processors": 8,
//     "lanes": {
//       "1": {
//         "OCD": {"call": 0, "pack": 0, "item": 1e-4, "spread": [0.99, 1, 1.01]},
//         ... "start", "CS", "RMA", "CCD", "shift", "other" (busy work)
//       }
//     },
//     "slowdowns": [{"from_processors": 8, "lanes": 1, "factor": 1.07,
//                    "why": "shared"}],
//     "conditions": [
//       {
//         "name": "near", "share": 0.6, "point_line": 2e-8, "tip_line": 4e-9,
//         "waits": {
//           "hold": {
//             "barrier": {"two": 1e-7, "further": 5e-8, "round": 1e-7,
//                         "level": 2e-7},
//             "event": 1e-7, "post": 0, "lock": 1e-7, "start": 1e-7,
//             "sleeps_after": 5e-5, "wake": 2e-5, "waker": 5e-6,
//             "turn": 2e-6, "shared_wake": 1e-5
//           }
//         }
//       }
//     ]
//   }
//
// Seconds throughout. "format", "name", "processors", "lanes" and "conditions"
// must be there; of the rest, what is not there is 0, empty or 1 as in
// machine.h. "sleeps_after" that is not there: never.

namespace bench::predict {

// The machine that `text` describes. Throws std::runtime_error, one sentence
// that begins with `name` and says where and what was expected, if it is no
// JSON, has members that nobody knows, misses some, or has figures that no
// machine has: no processors, lanes that are neither 1 nor 4, negative or
// infinite times, spreads that do not ascend or are not positive, shares that do
// not add up to 1 (to 1e-6), slowdowns of lanes that are not 0, 1 or 4, below 1
// or, of one width of lanes, not in ascending order, two conditions of one name,
// no condition, a condition without waits.
MachineModel ParseMachine(std::string_view text, std::string_view name);

// What ParseMachine() reads back as the same, to the bit.
std::string MachineText(const MachineModel& machine);

// The machine in the file `path`. Throws as ParseMachine(), also if the file
// cannot be read.
MachineModel ReadMachine(const std::string& path);

}  // namespace bench::predict
