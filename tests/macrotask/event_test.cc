#include "macrotask/event.h"

#include <gtest/gtest.h>

#include <atomic>
#include <vector>

#include "macrotask/task.h"
#include "tests/macrotask/support.h"

namespace macrotask {
namespace {

using EventTest = ByPolicy;

TEST_P(EventTest, IsClearedAtFirst) { EXPECT_FALSE(Event(GetParam()).Test()); }

TEST_P(EventTest, WaitReturnsAtOnceIfPostedBefore) {
  Event event(GetParam());
  event.Post();
  event.Wait();
  EXPECT_TRUE(event.Test());
}

TEST_P(EventTest, PostedEventStaysPostedUntilCleared) {
  Event event(GetParam());
  event.Post();
  event.Wait();
  event.Wait();
  EXPECT_TRUE(event.Test());
  event.Clear();
  EXPECT_FALSE(event.Test());
}

TEST_P(EventTest, PostAndClearAreHarmlessTwice) {
  Event event(GetParam());
  event.Clear();
  EXPECT_FALSE(event.Test());
  event.Post();
  event.Post();
  EXPECT_TRUE(event.Test());
  event.Clear();
  event.Clear();
  EXPECT_FALSE(event.Test());
  event.Post();
  EXPECT_TRUE(event.Test());
}

// Each event is posted and cleared once per trip by the other task, 1000 times.
TEST_P(EventTest, ReArmedPairCarriesTheBallThereAndBack) {
  Event ping(GetParam());
  Event pong(GetParam());
  int ball = 0;
  RunTasks(
      2,
      [&](int task) {
        for (int round = 0; round < 1000; ++round) {
          if (task == 0) {
            ++ball;
            ping.Post();
            pong.Wait();
            pong.Clear();
          } else {
            ping.Wait();
            ping.Clear();
            ++ball;
            pong.Post();
          }
        }
      },
      GetParam());
  EXPECT_EQ(ball, 2000);
}

// `Clear(); look; Wait()` against `write; Post()`: nothing written is missed.
TEST_P(EventTest, ClearBeforeTheLookMissesNoPost) {
  constexpr int kNumItems = 2000;
  Event changed(GetParam());
  std::atomic<int> num_written = 0;
  RunTasks(
      2,
      [&](int task) {
        if (task == 0) {
          for (int item = 1; item <= kNumItems; ++item) {
            num_written.store(item, std::memory_order_relaxed);
            changed.Post();
          }
        } else {
          for (;;) {
            changed.Clear();
            if (num_written.load(std::memory_order_relaxed) == kNumItems) break;
            changed.Wait();
          }
        }
      },
      GetParam());
  EXPECT_EQ(num_written, kNumItems);
}

INSTANTIATE_BY_POLICY(EventTest);

using EventWaitersTest = ByPolicyAndTasks;

TEST_P(EventWaitersTest, OnePostReleasesAllWithTheData) {
  for (int round = 0; round < 20; ++round) {
    Event event(policy());
    int data = 0;
    std::atomic<int> sum = 0;
    RunTasks(
        num_tasks() + 1,
        [&](int task) {
          if (task == 0) {
            data = 7;
            event.Post();
          } else {
            event.Wait();
            sum += data;
          }
        },
        policy());
    EXPECT_EQ(sum, 7 * num_tasks());
  }
}

// A task that is not waiting yet may miss a post that is cleared at once, so
// the pair is repeated; one that waited until the event *is* posted would
// hardly ever see it.
TEST_P(EventWaitersTest, PostFollowedAtOnceByClearReleasesAll) {
  Event event(policy());
  std::atomic<int> num_left = num_tasks();
  RunTasks(
      num_tasks() + 1,
      [&](int task) {
        if (task == 0) {
          YieldUntil([&] {
            event.Post();
            event.Clear();
            return num_left == 0;
          });
        } else {
          event.Wait();
          --num_left;
        }
      },
      policy());
  EXPECT_FALSE(event.Test());
}

// Task k waits for event k and posts event k + 1.
TEST_P(EventWaitersTest, ChainOfEventsRunsInOrder) {
  const auto size = static_cast<std::size_t>(num_tasks());
  std::vector<Event> events(size + 1);
  std::vector<int> order;
  events[0].Post();
  RunTasks(
      num_tasks(),
      [&](int task) {
        const auto k = static_cast<std::size_t>(task);
        events[k].Wait();
        order.push_back(task);
        events[k + 1].Post();
      },
      policy());
  ASSERT_EQ(order.size(), size);
  for (int task = 0; task < num_tasks(); ++task) {
    EXPECT_EQ(order[static_cast<std::size_t>(task)], task);
  }
}

INSTANTIATE_BY_POLICY_AND_TASKS(EventWaitersTest);

}  // namespace
}  // namespace macrotask
