#include "macrotask/trace_ring.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cstdint>
#include <vector>

#include "macrotask/task.h"

namespace macrotask {
namespace {

TraceRecord Numbered(std::uint64_t number) {
  return {1000 + number, number, 3, 2, TraceAction{65}};
}

TraceRecord LockTest(std::uint32_t task, std::uint32_t lock) {
  return {5, std::uint64_t{1} << 32 | lock, task, 0, TraceAction::kLockTestSet};
}

std::vector<TraceRecord> ReadAll(const TraceRing& ring) {
  std::uint64_t num_lost = 0;
  return ring.Read(&num_lost);
}

TEST(TraceRingTest, KeepsEveryFieldOfARecord) {
  TraceRing ring(4);
  const TraceRecord record = {~0ull, 0x123456789abcdef0, 0x7fffffff, 0xffff,
                              TraceAction{128}};
  ring.Append(record);
  EXPECT_EQ(ReadAll(ring), std::vector<TraceRecord>{record});
}

TEST(TraceRingTest, IsEmptyAtFirst) {
  EXPECT_TRUE(ReadAll(TraceRing(2)).empty());
}

TEST(TraceRingTest, OverwritesTheOldestAndCountsThem) {
  for (const std::size_t capacity : {2u, 4u, 64u}) {
    TraceRing ring(capacity);
    for (std::uint64_t n = 0; n < 200; ++n) {
      ring.Append(Numbered(n));
      std::uint64_t num_lost = 10;  // Read() adds
      const auto records = ring.Read(&num_lost);
      const std::uint64_t expected_lost = n < capacity ? 0 : n + 1 - capacity;
      ASSERT_EQ(num_lost, 10 + expected_lost);
      ASSERT_EQ(records.size(), n + 1 - expected_lost);
      for (std::size_t i = 0; i < records.size(); ++i) {
        ASSERT_EQ(records[i], Numbered(expected_lost + i));
      }
    }
  }
}

TEST(TraceRingTest, CountsTheSameTestInOneRecord) {
  TraceRing ring(2);
  ring.Append(Numbered(0));
  for (int i = 0; i < 10; ++i) ring.Append(LockTest(1, 4));
  const auto records = ReadAll(ring);
  ASSERT_EQ(records.size(), 2u);
  EXPECT_EQ(records[0], Numbered(0));
  EXPECT_EQ(records[1].object(), 4u);
  EXPECT_EQ(records[1].detail(), 10u);
}

TEST(TraceRingTest, CountsTestsOfAnotherObjectOrTaskApart) {
  TraceRing ring(8);
  ring.Append(LockTest(1, 4));
  ring.Append(LockTest(1, 5));
  ring.Append(LockTest(1, 4));
  ring.Append(LockTest(2, 4));
  ring.Append(LockTest(2, 4));
  std::vector<std::uint32_t> counts;
  for (const TraceRecord& record : ReadAll(ring)) {
    counts.push_back(record.detail());
  }
  EXPECT_EQ(counts, (std::vector<std::uint32_t>{1, 1, 1, 2}));
}

// A small ring, so that the owner comes round while another task reads.
TEST(TraceRingTest, WhoReadsBesideTheOwnerSeesWholeRecordsInOrder) {
  constexpr std::uint64_t kNumRecords = 1'000'000;
  TraceRing ring(64);
  std::atomic<std::uint64_t> num_appended = 0;
  Task owner([&] {
    for (std::uint64_t n = 0; n < kNumRecords; ++n) {
      ring.Append(Numbered(n));
      num_appended = n + 1;
    }
  });
  std::int64_t num_errors = 0;
  while (num_appended < kNumRecords) {
    const std::uint64_t least = num_appended;
    std::uint64_t num_lost = 0;
    const auto records = ring.Read(&num_lost);
    num_errors += num_lost + records.size() < least;
    for (std::size_t i = 0; i < records.size(); ++i) {
      num_errors += records[i] != Numbered(num_lost + i);
    }
  }
  EXPECT_EQ(num_errors, 0);
}

}  // namespace
}  // namespace macrotask
