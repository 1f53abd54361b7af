#include "bench/ping_pong.h"

#include "macrotask/event.h"
#include "macrotask/task.h"

namespace bench {

void PingPong(macrotask::WaitPolicy wait, int num_hand_overs) {
  macrotask::Event ping(wait), pong(wait);
  const auto play = [&](macrotask::Event& from, macrotask::Event& to,
                        bool first) {
    for (int round = 0; round < num_hand_overs / 2; ++round) {
      if (first) to.Post();
      from.Wait();
      from.Clear();
      if (!first) to.Post();
    }
  };
  macrotask::RunTasks(
      2,
      [&](int task) {
        if (task == 0) {
          play(pong, ping, true);
        } else {
          play(ping, pong, false);
        }
      },
      wait);
}

}  // namespace bench
