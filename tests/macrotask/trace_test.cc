#include "macrotask/trace.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <ostream>
#include <stdexcept>
#include <string>
#include <vector>

#include "macrotask/barrier.h"
#include "macrotask/clock.h"
#include "macrotask/event.h"
#include "macrotask/lock.h"
#include "macrotask/task.h"
#include "macrotask/trace_text.h"
#include "tests/macrotask/support.h"

namespace macrotask {
namespace {

using enum TraceAction;

// What a record says apart from time and processor.
struct Entry {
  std::uint32_t task;
  TraceAction action;
  std::uint64_t data;
  friend bool operator==(const Entry&, const Entry&) = default;
};

void PrintTo(const Entry& entry, std::ostream* out) {
  *out << "task " << entry.task << " " << Name(entry.action) << " "
       << entry.data;
}

// Records everything, or what the test chooses, from an empty beginning: what
// earlier tests have left in the rings is older than `begin_`.
class TraceTest : public testing::Test {
 protected:
  TraceTest() { Begin(kAllTraceClasses); }
  ~TraceTest() override { SetTraceClasses(0); }

  void Begin(std::uint32_t classes) {
    SetTraceClasses(classes);
    begin_ = ReadStamp().clock;
  }

  std::vector<TraceRecord> Records() const {
    auto records = InOrderOfTime(TakeTrace());
    std::erase_if(records, [this](const TraceRecord& record) {
      return record.clock < begin_;
    });
    return records;
  }

  std::vector<Entry> EntriesOf(std::uint32_t task) const {
    std::vector<Entry> entries;
    for (const TraceRecord& record : Records()) {
      if (record.task != task) continue;
      entries.push_back({record.task, record.action, record.data});
    }
    return entries;
  }

 private:
  std::uint64_t begin_;
};

using Entries = std::vector<Entry>;

TEST_F(TraceTest, RecordsEveryCallOnALock) {
  Lock lock;
  const std::uint64_t number = lock.number();
  lock.On();
  EXPECT_TRUE(lock.Test());
  lock.Off();
  EXPECT_FALSE(lock.Test());
  EXPECT_EQ(EntriesOf(1),
            (Entries{{1, kLockOn, number},
                     {1, kLockOnEnd, number},
                     {1, kLockTestSet, TraceData(lock.number(), 1)},
                     {1, kLockOff, number},
                     {1, kLockTestOn, number}}));
}

TEST_F(TraceTest, RecordsEveryCallOnAnEvent) {
  Event event;
  const std::uint64_t number = event.number();
  const std::uint64_t once = TraceData(event.number(), 1);
  EXPECT_FALSE(event.Test());
  event.Post();
  EXPECT_TRUE(event.Test());
  event.Wait();
  event.Clear();
  EXPECT_EQ(EntriesOf(1), (Entries{{1, kEventTestClear, once},
                                   {1, kEventPost, number},
                                   {1, kEventTest, once},
                                   {1, kEventWait, number},
                                   {1, kEventWaitEnd, number},
                                   {1, kEventClear, number}}));
}

TEST_F(TraceTest, RecordsEveryCallOnABarrier) {
  Barrier barrier(1);
  const std::uint64_t data = TraceData(barrier.number(), 1);
  barrier.Sync();
  EXPECT_EQ(EntriesOf(1),
            (Entries{{1, kBarrierSync, data}, {1, kBarrierSyncEnd, data}}));
}

TEST_F(TraceTest, LeanOneLeavesOutWhatHoldsNobody) {
  Begin(kAllTraceClasses | kLeanTrace);
  Barrier barrier(1);
  Event event;
  barrier.Sync();
  EXPECT_FALSE(event.Test());
  event.Post();
  event.Wait();
  event.Clear();
  const std::uint64_t number = event.number();
  std::vector<Entry> entries = EntriesOf(1);
  std::erase_if(entries, [](const Entry& entry) {
    return ClassOf(entry.action) == TraceClass::kInfo;
  });
  EXPECT_EQ(entries, (Entries{{1, kEventPost, number},
                              {1, kEventWait, number},
                              {1, kEventWaitEnd, number}}));
  EXPECT_EQ(TakeTrace().classes, kAllTraceClasses);
}

TEST_F(TraceTest, RecordsTheLifeOfATask) {
  Task task([] { RecordUser(70, 0xfedcba9876543210); }, {.value = 1234});
  const std::uint32_t number = task.number();
  task.Wait();
  EXPECT_FALSE(task.Test());
  std::vector<Entry> mine = EntriesOf(1);
  std::erase_if(mine, [](const Entry& entry) {
    return ClassOf(entry.action) == TraceClass::kCpus;
  });
  EXPECT_EQ(mine, (Entries{{1, kTaskStart, number},
                           {1, kTaskWait, number},
                           {1, kTaskWaitEnd, number},
                           {1, kTaskTest, number}}));
  EXPECT_EQ(EntriesOf(number),
            (Entries{{number, kTaskBegin, 1234},
                     {number, TraceAction{70}, 0xfedcba9876543210},
                     {number, kTaskEnd, 0}}));
}

TEST_F(TraceTest, RecordsThatATaskSleepsWithinItsWait) {
  Event event(WaitPolicy::Block());
  Task sleeper([&] { event.Wait(); });
  const std::uint32_t number = sleeper.number();
  YieldUntil([&] { return EntriesOf(number).size() == 3; });
  event.Post();
  sleeper.Wait();
  const std::uint64_t data = event.number();
  EXPECT_EQ(EntriesOf(number), (Entries{{number, kTaskBegin, 0},
                                        {number, kEventWait, data},
                                        {number, kSleep, 0},
                                        {number, kWake, 0},
                                        {number, kEventWaitEnd, data},
                                        {number, kTaskEnd, 0}}));
}

// A record of every class at least.
void UseEverything() {
  Lock lock;
  lock.On();
  Event event(WaitPolicy::Block());
  Task task([&] { event.Wait(); }, {.wait = WaitPolicy::Block()});
  YieldUntil([&] { return lock.Test() && task.Test(); });
  event.Post();
  task.Wait();
  Barrier(1).Sync();
  Event never(WaitPolicy::Block());
  Barrier both(2, WaitPolicy::Block());
  RunTasks(
      2, [&](int) { both.Sync(); }, WaitPolicy::Hold());
  RecordUser(65, 1);
  SetTraceClasses(TraceClasses());
}

TEST_F(TraceTest, RecordsOnlyTheClassesThatAreOn) {
  for (std::uint32_t bit = 1; bit <= kAllTraceClasses; bit <<= 1) {
    Begin(bit);
    EXPECT_EQ(TraceClasses(), bit);
    UseEverything();
    SetTraceClasses(0);
    const auto records = Records();
    EXPECT_FALSE(records.empty()) << bit;
    for (const TraceRecord& record : records) {
      EXPECT_EQ(static_cast<std::uint32_t>(ClassOf(record.action)), bit)
          << Name(record.action);
    }
  }
}

TEST_F(TraceTest, RecordsNothingWhenSwitchedOff) {
  Begin(0);
  UseEverything();
  EXPECT_EQ(TraceClasses(), 0u);
  EXPECT_TRUE(Records().empty());
}

TEST_F(TraceTest, RecordsTheClassesWhenTheyChange) {
  SetTraceClasses(32 | 4);
  EXPECT_EQ(EntriesOf(1), (Entries{{1, kTraceClasses, 36}}));
  EXPECT_EQ(TakeTrace().classes, 36u);
}

TEST_F(TraceTest, CountsTestsInARowInOneRecord) {
  Lock set;
  Event clear;
  set.On();
  Begin(kAllTraceClasses);
  for (int i = 0; i < 1000; ++i) EXPECT_TRUE(set.Test());
  for (int i = 0; i < 500; ++i) EXPECT_FALSE(clear.Test());
  EXPECT_TRUE(set.Test());
  EXPECT_EQ(EntriesOf(1),
            (Entries{{1, kLockTestSet, TraceData(set.number(), 1000)},
                     {1, kEventTestClear, TraceData(clear.number(), 500)},
                     {1, kLockTestSet, TraceData(set.number(), 1)}}));
}

TEST_F(TraceTest, CountsTestsOfDifferentObjectsApart) {
  Event one, other;
  EXPECT_FALSE(one.Test());
  EXPECT_FALSE(other.Test());
  EXPECT_FALSE(one.Test());
  EXPECT_EQ(EntriesOf(1).size(), 3u);
}

// The second task most likely runs on the pthread of the first.
TEST_F(TraceTest, CountsTestsOfDifferentTasksApart) {
  Begin(static_cast<std::uint32_t>(TraceClass::kLocks));
  Lock set;
  set.On();
  const auto test = [&] { EXPECT_TRUE(set.Test()); };
  const std::uint64_t data = TraceData(set.number(), 1);
  for (int round = 0; round < 2; ++round) {
    Task task(test);
    task.Wait();
    EXPECT_EQ(EntriesOf(task.number()),
              (Entries{{task.number(), kLockTestSet, data}}));
  }
}

TEST_F(TraceTest, RefusesForeignUserActions) {
  for (const std::int64_t action :
       {std::int64_t{64}, std::int64_t{129}, std::int64_t{0}, std::int64_t{-65},
        std::int64_t{65} + (std::int64_t{1} << 32),
        std::numeric_limits<std::int64_t>::min()}) {
    EXPECT_THROW(RecordUser(action, 0), std::invalid_argument) << action;
  }
  EXPECT_TRUE(Records().empty());
  RecordUser(65, 1);
  RecordUser(128, 2);
  EXPECT_EQ(EntriesOf(1),
            (Entries{{1, TraceAction{65}, 1}, {1, TraceAction{128}, 2}}));
  try {
    RecordUser(129, 0);
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(), "user action 129: expected 65 to 128");
  }
}

TEST_F(TraceTest, RefusesBuffersThatAreTooSmallOrTooLarge) {
  for (const std::size_t size :
       {std::size_t{0}, std::size_t{1}, (std::size_t{1} << 28) + 1}) {
    EXPECT_THROW(SetTraceSize(size), std::invalid_argument) << size;
  }
}

}  // namespace
}  // namespace macrotask
