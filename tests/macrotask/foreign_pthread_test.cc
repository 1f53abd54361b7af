// Pthreads that this library has not made are tasks once they have waited.

#include <gtest/gtest.h>
#include <pthread.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <thread>
#include <vector>

#include "macrotask/event.h"
#include "macrotask/lock.h"
#include "macrotask/task.h"
#include "macrotask/task_list.h"
#include "tests/macrotask/support.h"

namespace macrotask {
namespace {

// The numbers of the tasks that wait for the event.
std::vector<std::uint32_t> WaitersFor(const Event& event) {
  std::vector<std::uint32_t> numbers;
  for (const TaskStatus& task : ListTasks()) {
    if (task.waits_for == ObjectKind::kEvent && task.object == event.number()) {
      numbers.push_back(task.number);
    }
  }
  return numbers;
}

using ForeignPthreadTest = ByPolicy;

TEST_P(ForeignPthreadTest, IsListedWhileItWaits) {
  Event event(GetParam());
  std::vector<std::thread> threads;
  for (int i = 0; i < 3; ++i) threads.emplace_back([&] { event.Wait(); });
  YieldUntil([&] { return WaitersFor(event).size() == 3; });
  event.Post();
  for (std::thread& thread : threads) thread.join();
  EXPECT_TRUE(WaitersFor(event).empty());
}

TEST_P(ForeignPthreadTest, HasOneNumberUntilItEnds) {
  Event one(GetParam());
  Event other(GetParam());
  std::thread thread([&] {
    one.Wait();
    other.Wait();
  });
  YieldUntil([&] { return !WaitersFor(one).empty(); });
  const auto number = WaitersFor(one);
  one.Post();
  YieldUntil([&] { return !WaitersFor(other).empty(); });
  EXPECT_EQ(WaitersFor(other), number);
  other.Post();
  thread.join();
}

TEST_P(ForeignPthreadTest, HoldsTheLockThatItGotByWaiting) {
  Lock lock(GetParam());
  Event seen(GetParam());
  lock.On();
  std::thread thread([&] {
    lock.On();
    seen.Wait();
    lock.Off();
  });
  YieldUntil([&] { return lock.num_waiting() == 1; });
  lock.Off();
  YieldUntil([&] { return !WaitersFor(seen).empty(); });
  EXPECT_EQ(lock.holder(), WaitersFor(seen).front());
  seen.Post();
  thread.join();
}

// What the destructor of a key of the program's own waits for. The key is
// younger than the library's, whose destructor therefore comes first.
Event* awaited_at_end = nullptr;

TEST_P(ForeignPthreadTest, MayWaitWhileItEnds) {
  Event first(GetParam());
  Event second(GetParam());
  Event at_end(GetParam());
  awaited_at_end = &at_end;
  pthread_key_t key;
  ASSERT_EQ(pthread_key_create(&key, [](void*) { awaited_at_end->Wait(); }), 0);
  std::thread ending([&] {
    pthread_setspecific(key, &key);
    first.Wait();
  });
  YieldUntil([&] { return !WaitersFor(first).empty(); });
  first.Post();
  YieldUntil([&] { return !WaitersFor(at_end).empty(); });
  // Another one, which must not be taken for the first.
  std::thread other([&] { second.Wait(); });
  YieldUntil([&] { return !WaitersFor(second).empty(); });
  EXPECT_EQ(WaitersFor(at_end).size(), 1u);
  EXPECT_NE(WaitersFor(at_end), WaitersFor(second));
  at_end.Post();
  ending.join();
  second.Post();
  other.join();
  pthread_key_delete(key);
}

// Many, one after the other and side by side, so that records are used again.
TEST_P(ForeignPthreadTest, ComesAndGoesBesideTasks) {
  std::atomic<int> num_released = 0;
  for (int round = 0; round < 30; ++round) {
    Event event(GetParam());
    RunTasks(
        3,
        [&](int task) {
          if (task == 0) {
            YieldUntil([&] { return WaitersFor(event).size() == 4; });
            return event.Post();
          }
          std::vector<std::thread> threads;
          for (int i = 0; i < 2; ++i) {
            threads.emplace_back([&] {
              event.Wait();
              ++num_released;
            });
          }
          for (std::thread& thread : threads) thread.join();
        },
        OnPthreads(GetParam()));
  }
  EXPECT_EQ(num_released, 120);
}

INSTANTIATE_BY_POLICY(ForeignPthreadTest);

}  // namespace
}  // namespace macrotask
