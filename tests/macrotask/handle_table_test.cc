#include "macrotask/cray/handle_table.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cstdint>
#include <limits>
#include <set>
#include <stdexcept>
#include <vector>

#include "macrotask/task.h"

namespace macrotask::cray {
namespace {

using Table = HandleTable<int>;

constexpr HandleKind kKinds[] = {HandleKind::kLock, HandleKind::kEvent,
                                 HandleKind::kBarrier};

TEST(MakeHandleTest, PartsAreReadBackAndTheHandleIsAPositiveInt) {
  for (const HandleKind kind : kKinds) {
    for (const std::uint32_t generation : {0u, 1u, kMostGeneration}) {
      for (const std::uint32_t index : {0u, 1u, 255u, 256u, kMostIndex}) {
        const std::uint32_t handle = MakeHandle(kind, generation, index);
        EXPECT_EQ(KindOf(handle), static_cast<std::uint32_t>(kind));
        EXPECT_EQ(GenerationOf(handle), generation);
        EXPECT_EQ(IndexOf(handle), index);
        EXPECT_GT(static_cast<std::int32_t>(handle), 0);
      }
    }
  }
}

TEST(HandleTableTest, FindsWhatWasAssigned) {
  Table table(HandleKind::kLock);
  int one = 0, other = 0;
  const std::uint32_t first = table.Assign(&one);
  const std::uint32_t second = table.Assign(&other);
  EXPECT_NE(first, second);
  EXPECT_EQ(table.Find(first), &one);
  EXPECT_EQ(table.Find(second), &other);
}

TEST(HandleTableTest, FindsNothingElse) {
  int object = 0;
  Table table(HandleKind::kEvent);
  const std::int64_t handle = table.Assign(&object);
  constexpr std::int64_t kTwoTo32 = std::int64_t{1} << 32;
  for (const std::int64_t garbage :
       {std::int64_t{0}, std::int64_t{1}, std::int64_t{-1}, -handle, handle + 1,
        handle + kTwoTo32, handle - kTwoTo32, std::int64_t{0x7fffffff},
        std::numeric_limits<std::int64_t>::min(),
        std::numeric_limits<std::int64_t>::max()}) {
    EXPECT_EQ(table.Find(garbage), nullptr) << garbage;
    EXPECT_FALSE(table.WasReleased(garbage)) << garbage;
  }
}

TEST(HandleTableTest, KeepsTheKindsApart) {
  int object = 0;
  for (const HandleKind kind : kKinds) {
    Table table(kind);
    const std::uint32_t handle = table.Assign(&object);
    for (const HandleKind other_kind : kKinds) {
      if (other_kind == kind) continue;
      Table other(other_kind);
      other.Assign(&object);
      EXPECT_EQ(other.Find(handle), nullptr);
    }
  }
}

TEST(HandleTableTest, FindsOutAStaleHandleAfterItsSlotIsInUseAgain) {
  Table table(HandleKind::kBarrier);
  int one = 0, other = 0;
  const std::uint32_t stale = table.Assign(&one);
  EXPECT_FALSE(table.WasReleased(stale));
  table.Release(stale);
  EXPECT_EQ(table.Find(stale), nullptr);
  EXPECT_TRUE(table.WasReleased(stale));
  const std::uint32_t fresh = table.Assign(&other);
  EXPECT_EQ(IndexOf(fresh), IndexOf(stale));
  EXPECT_NE(fresh, stale);
  EXPECT_EQ(table.Find(stale), nullptr);
  EXPECT_TRUE(table.WasReleased(stale));
  EXPECT_EQ(table.Find(fresh), &other);
  EXPECT_FALSE(table.WasReleased(fresh));
}

TEST(HandleTableTest, GivesASlotAsManyHandlesAsThereAreGenerations) {
  Table table(HandleKind::kLock);
  int object = 0;
  std::set<std::uint32_t> handles;
  for (std::uint32_t i = 0; i < kMostGeneration; ++i) {
    const std::uint32_t handle = table.Assign(&object);
    EXPECT_GT(handle, 0u);
    handles.insert(handle);
    table.Release(handle);
  }
  EXPECT_EQ(handles.size(), kMostGeneration);
  // Round once more, and still never 0.
  const std::uint32_t again = table.Assign(&object);
  EXPECT_EQ(again, *handles.begin());
  EXPECT_EQ(table.Find(again), &object);
}

// Not inline: GCC 12 would warn of the null slot that the handle has not.
[[gnu::noinline]] void Replace(Table* table, std::uint32_t handle,
                               int* object) {
  table->Replace(handle, object);
}

TEST(HandleTableTest, PutsAnotherObjectBehindTheSameHandle) {
  Table table(HandleKind::kBarrier);
  int one = 0, other = 0;
  const std::uint32_t handle = table.Assign(&one);
  Replace(&table, handle, &other);
  EXPECT_EQ(table.Find(handle), &other);
}

TEST(HandleTableTest, SaysWhenAllHandlesAreInUse) {
  Table table(HandleKind::kEvent);
  std::vector<int> objects(kMostIndex + 1);
  std::vector<std::uint32_t> handles;
  for (int& object : objects) handles.push_back(table.Assign(&object));
  for (std::size_t i = 0; i < handles.size(); ++i) {
    ASSERT_EQ(table.Find(handles[i]), &objects[i]);
  }
  int one_more = 0;
  try {
    table.Assign(&one_more);
    FAIL() << "nothing was thrown";
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(),
                 "65536 are assigned already, no more are possible");
  }
  table.Release(handles[7]);
  EXPECT_EQ(table.Find(table.Assign(&one_more)), &one_more);
}

// New chunks come while another task looks.
TEST(HandleTableTest, FindsBesideATaskThatAssigns) {
  Table table(HandleKind::kLock);
  std::vector<int> objects(10'000);
  std::atomic<std::uint32_t> last = table.Assign(objects.data());
  Task assigner([&] {
    for (int& object : objects) {
      object = 1;
      last.store(table.Assign(&object), std::memory_order_relaxed);
    }
  });
  while (assigner.Test()) {
    const int* const object = table.Find(last.load(std::memory_order_relaxed));
    ASSERT_NE(object, nullptr);
    if (object != objects.data()) {
      EXPECT_EQ(*object, 1);
    }
  }
}

TEST(HandleTableTest, TellsAStaleHandleBesideATaskThatUsesItsSlot) {
  Table table(HandleKind::kLock);
  int object = 0;
  const std::uint32_t stale = table.Assign(&object);
  table.Release(stale);
  Task user([&] {
    for (int round = 0; round < 1000; ++round) {
      table.Release(table.Assign(&object));
    }
  });
  do {
    EXPECT_TRUE(table.WasReleased(stale));
  } while (user.Test());
}

}  // namespace
}  // namespace macrotask::cray
