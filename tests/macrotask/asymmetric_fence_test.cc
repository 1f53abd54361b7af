#include "macrotask/asymmetric_fence.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>

#include "macrotask/barrier.h"
#include "macrotask/cache_line.h"
#include "macrotask/task.h"

namespace macrotask {
namespace {

// With two light fences one round in ten fails on x86-64.
TEST(AsymmetricFenceTest, OneOfTwoTasksSeesWhatTheOtherHasWritten) {
  if (!has_heavy_fence) GTEST_SKIP() << "the system has no heavy fence";
  constexpr int kNumRounds = 5000;
  CacheAligned<std::atomic<int>> written[2];
  CacheAligned<std::atomic<int>> seen[2];
  int num_blind_rounds = 0;
  Barrier barrier(2);
  RunTasks(2, [&](int task) {
    for (int round = 1; round <= kNumRounds; ++round) {
      barrier.Sync();
      written[task]->store(round, std::memory_order_relaxed);
      if (task == 0) {
        LightFence();
      } else {
        HeavyFence();
      }
      seen[task]->store(written[1 - task]->load(std::memory_order_relaxed),
                        std::memory_order_relaxed);
      barrier.Sync();
      const int last_seen = std::max(seen[0]->load(std::memory_order_relaxed),
                                     seen[1]->load(std::memory_order_relaxed));
      if (task == 0 && last_seen < round) ++num_blind_rounds;
    }
  });
  EXPECT_EQ(num_blind_rounds, 0);
}

}  // namespace
}  // namespace macrotask
