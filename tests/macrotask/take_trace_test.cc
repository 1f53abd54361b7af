// What TakeTrace() says of many tasks, and of itself.

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include "macrotask/clock.h"
#include "macrotask/placement.h"
#include "macrotask/task.h"
#include "macrotask/trace.h"
#include "tests/macrotask/support.h"

namespace macrotask {
namespace {

class TakeTraceTest : public testing::Test {
 protected:
  TakeTraceTest() { SetTraceClasses(kAllTraceClasses); }
  ~TakeTraceTest() override { SetTraceClasses(0); }
};

TEST_F(TakeTraceTest, EveryTaskHasItsOwnEntriesInOrderOfTime) {
  constexpr std::uint64_t kNumEntries = 2000;
  std::vector<std::uint32_t> numbers;
  std::vector<std::unique_ptr<Task>> tasks;
  for (int i = 0; i < 16; ++i) {
    tasks.push_back(std::make_unique<Task>([] {
      for (std::uint64_t n = 0; n < kNumEntries; ++n) RecordUser(66, n);
    }));
    numbers.push_back(tasks.back()->number());
  }
  for (auto& task : tasks) task->Wait();
  SetTraceClasses(0);
  const Trace trace = TakeTrace();
  std::map<std::uint32_t, std::uint64_t> next;
  for (const TraceBuffer& buffer : trace.buffers) {
    EXPECT_EQ(buffer.num_lost, 0u);
    std::uint64_t before = 0;
    for (const TraceRecord& record : buffer.records) {
      EXPECT_GE(record.clock, before);
      before = record.clock;
      if (record.action != TraceAction{66}) continue;
      EXPECT_EQ(record.data, next[record.task]++);
    }
  }
  for (const std::uint32_t number : numbers) {
    EXPECT_EQ(next[number], kNumEntries);
  }
}

TEST_F(TakeTraceTest, MayBeTakenBesideTasksThatRecord) {
  std::atomic<bool> over = false;
  std::atomic<int> num_recording = 0;
  std::vector<std::unique_ptr<Task>> tasks;
  for (int i = 0; i < 3; ++i) {
    tasks.push_back(std::make_unique<Task>([&] {
      ++num_recording;
      for (std::uint64_t n = 0; !over; ++n) RecordUser(67, n);
    }));
  }
  YieldUntil([&] { return num_recording == 3; });
  int num_errors = 0;
  for (int round = 0; round < 10; ++round) {
    for (const TraceBuffer& buffer : TakeTrace().buffers) {
      const TraceRecord* before = nullptr;
      for (const TraceRecord& record : buffer.records) {
        if (record.action != TraceAction{67}) continue;
        if (before != nullptr && before->task == record.task) {
          num_errors += record.data != before->data + 1;
          num_errors += record.clock < before->clock;
        }
        before = &record;
      }
    }
  }
  over = true;
  EXPECT_EQ(num_errors, 0);
}

TEST_F(TakeTraceTest, KnowsTheRateOfItsClock) {
  const auto time = std::chrono::steady_clock::now();
  const std::uint64_t clock = ReadStamp().clock;
  while (std::chrono::steady_clock::now() - time <
         std::chrono::milliseconds(100)) {
  }
  const std::uint64_t ticks = ReadStamp().clock - clock;
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - time)
          .count();
  // A fifth: the task may be interrupted between two readings.
  EXPECT_NEAR(TakeTrace().ticks_per_second * seconds,
              static_cast<double>(ticks), 0.2 * static_cast<double>(ticks));
}

TEST_F(TakeTraceTest, SaysWhenAndWhereItWasTaken) {
  RecordUser(65, 0);
  const Trace trace = TakeTrace();
  EXPECT_GT(trace.last_clock, trace.first_clock);
  EXPECT_EQ(trace.num_processors, static_cast<std::uint32_t>(NumProcessors()));
  const auto unix_ns = std::chrono::duration_cast<std::chrono::nanoseconds>(
                           std::chrono::system_clock::now().time_since_epoch())
                           .count();
  EXPECT_LE(trace.first_unix_ns, unix_ns);
  EXPECT_GT(trace.Seconds(trace.last_clock), 0.0);
}

}  // namespace
}  // namespace macrotask
