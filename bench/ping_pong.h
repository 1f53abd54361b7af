#pragma once

#include "macrotask/wait_policy.h"

namespace bench {

// Two tasks post each other's event, `num_hand_overs` times all in all: each
// EVPOST lets the other one return from its EVWAIT, on fresh events.
void PingPong(macrotask::WaitPolicy wait, int num_hand_overs);

}  // namespace bench
