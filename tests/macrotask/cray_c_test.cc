// The C interface as client programs use it, with handles of both widths.

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <cstdint>
#include <set>
#include <vector>

#include "macrotask/cray.h"
#include "macrotask/placement.h"
#include "tests/macrotask/cray_support.h"
#include "tests/macrotask/process.h"

namespace macrotask {
namespace {

template <typename Word>
class CrayCTest : public testing::Test {};

using Widths = testing::Types<int, long>;
TYPED_TEST_SUITE(CrayCTest, Widths);

TYPED_TEST(CrayCTest, OfTasksThatRaceToAssignALockOneWins) {
  using Word = TypeParam;
  for (int round = 0; round < 50; ++round) {
    Word lock = -7;
    int total = 0;
    std::array<Word, 16> seen;
    RunCrayTasks<Word>(16, [&](int task) {
      LOCKASGN(&lock, Word{-7});
      LOCKON(&lock);
      seen[static_cast<std::size_t>(task)] = lock;
      ++total;
      LOCKOFF(&lock);
    });
    EXPECT_EQ(total, 16);
    EXPECT_EQ(std::set<Word>(seen.begin(), seen.end()).size(), 1u);
    EXPECT_GT(lock, 0);
    LOCKREL(&lock);
  }
}

TYPED_TEST(CrayCTest, OfTasksThatRaceToAssignAnEventOneWins) {
  using Word = TypeParam;
  Word event = 0;
  RunCrayTasks<Word>(16, [&](int) {
    EVASGN(&event, Word{0});
    EVPOST(&event);  // A second assignment would clear it.
    EXPECT_TRUE(EVTEST(&event));
  });
  EVREL(&event);
}

TYPED_TEST(CrayCTest, TasksSpinOnLocktest) {
  using Word = TypeParam;
  constexpr int kNumCalls = kSanitized ? 200'000 : 10'000'000;
  const int num_tasks = NumProcessors() + 2;
  Word lock = 0;
  LOCKASGN(&lock);
  std::int64_t total = 0;  // guarded by the lock
  std::atomic<std::int64_t> num_taken = 0;
  RunCrayTasks<Word>(num_tasks, [&](int) {
    std::int64_t taken = 0;
    for (int call = 0; call < kNumCalls / num_tasks; ++call) {
      if (LOCKTEST(&lock)) continue;
      ++total;
      ++taken;
      LOCKOFF(&lock);
    }
    num_taken += taken;
  });
  EXPECT_EQ(total, num_taken);
  EXPECT_GT(total, 0);
  LOCKREL(&lock);
}

TYPED_TEST(CrayCTest, LockIsSetUntilUnlockedByAnybody) {
  using Word = TypeParam;
  Word lock = 0;
  LOCKASGN(&lock);
  EXPECT_EQ(LOCKTEST(&lock), 0);
  EXPECT_EQ(LOCKTEST(&lock), 1);
  RunCrayTasks<Word>(1, [&](int) { LOCKOFF(&lock); });
  EXPECT_EQ(LOCKTEST(&lock), 0);
  const Word before = lock;
  LOCKASGN(&lock);  // clears it
  EXPECT_EQ(lock, before);
  EXPECT_EQ(LOCKTEST(&lock), 0);
  LOCKOFF(&lock);
  LOCKREL(&lock);
}

TYPED_TEST(CrayCTest, AssigningAnEventAgainClearsIt) {
  TypeParam event = 0;
  for (int round = 0; round < 1000; ++round) {
    EVASGN(&event);
    EXPECT_EQ(EVTEST(&event), 0);
    EVPOST(&event);
    EVPOST(&event);
    EVWAIT(&event);
    EXPECT_EQ(EVTEST(&event), 1);
    if (round % 2 == 0) EVCLEAR(&event);
  }
  EVREL(&event);
}

TYPED_TEST(CrayCTest, ThreeTasksPostAndWaitInTurn) {
  using Word = TypeParam;
  std::array<Word, 3> turns = {};
  for (Word& turn : turns) EVASGN(&turn);
  int num_turns = 0;
  EVPOST(&turns[0]);
  RunCrayTasks<Word>(3, [&](int task) {
    const auto mine = static_cast<std::size_t>(task);
    for (int round = 0; round < 1000; ++round) {
      EVWAIT(&turns[mine]);
      EVCLEAR(&turns[mine]);
      EXPECT_EQ(num_turns++ % 3, task);
      EVPOST(&turns[(mine + 1) % 3]);
    }
  });
  EXPECT_EQ(num_turns, 3000);
  for (Word& turn : turns) EVREL(&turn);
}

TYPED_TEST(CrayCTest, BarrierSeparatesPhases) {
  for (const int num_tasks : kTaskCounts) {
    TypeParam barrier = 0;
    BARASGN(&barrier, num_tasks);
    EXPECT_EQ(CountPhaseErrors(num_tasks, 100 / num_tasks,
                               [&](int) { BARSYNC(&barrier); }),
              0);
    BARREL(&barrier);
  }
}

TYPED_TEST(CrayCTest, BarrierMayBeAssignedAgainForOtherNumbers) {
  TypeParam barrier = 0;
  BARASGN(&barrier, 1);
  const TypeParam handle = barrier;
  for (const int num_tasks : {4, 2, 16, 1, 4, 2}) {
    BARASGN(&barrier, num_tasks);
    EXPECT_EQ(barrier, handle);
    EXPECT_EQ(CountPhaseErrors(num_tasks, 10, [&](int) { BARSYNC(&barrier); }),
              0);
  }
  BARREL(&barrier);
}

TYPED_TEST(CrayCTest, VariableMayBeReleasedAndAssignedAgain) {
  TypeParam lock = 0, event = 0, barrier = 0;
  for (int round = 0; round < 20'000; ++round) {
    LOCKASGN(&lock);
    EVASGN(&event);
    BARASGN(&barrier, 1);
    ASSERT_EQ(LOCKTEST(&lock), 0);
    ASSERT_EQ(EVTEST(&event), 0);
    EVPOST(&event);
    BARSYNC(&barrier);
    LOCKOFF(&lock);
    LOCKREL(&lock);
    EVREL(&event);
    BARREL(&barrier);
  }
}

// --- Tasks ------------------------------------------------------------------

long received[20];

extern "C" void TakeTwentyWords(long a, long b, long c, long d, long e, long f,
                                long g, long h, long i, long j, long k, long l,
                                long m, long n, long o, long p, long q, long r,
                                long s, long* t) {
  const long words[] = {a, b, c, d, e, f, g, h, i, j,
                        k, l, m, n, o, p, q, r, s, *t};
  std::copy(std::begin(words), std::end(words), received);
}

TYPED_TEST(CrayCTest, TaskReceivesTwentyWords) {
  TypeParam tca[2] = {2, 0};
  long last = -20;
  TSKSTART(tca, AsRoutine(&TakeTwentyWords), -1L, 2L, 3L, 4L, 5L, 6L, 7L, 8L,
           9L, 10L, 11L, 12L, 13L, 14L, 15L, 16L, 17L, 18L, 0x7fffffffffffffffL,
           &last);
  TSKWAIT(tca);
  EXPECT_EQ(received[0], -1);
  for (int i = 1; i < 18; ++i) EXPECT_EQ(received[i], i + 1);
  EXPECT_EQ(received[18], 0x7fffffffffffffff);
  EXPECT_EQ(received[19], -20);
}

extern "C" void AddTo(int* sum, int addend) { *sum += addend; }
extern "C" void AddOne(std::atomic<int>* sum) { ++*sum; }

TYPED_TEST(CrayCTest, WordsMayBeIntegersByValueAndAddresses) {
  TypeParam tca[2] = {2, 0};
  int sum = 1;
  TSKSTART(tca, AsRoutine(&AddTo), &sum, -40);
  TSKWAIT(tca);
  EXPECT_EQ(sum, -39);
}

TYPED_TEST(CrayCTest, TaskControlArrayMayBeUsedAgain) {
  TypeParam tca[2] = {2, 123'456'789};  // garbage, as it was found
  std::set<TypeParam> numbers;
  std::atomic<int> sum = 0;
  for (int round = 0; round < 50; ++round) {
    TSKSTART(tca, AsRoutine(&AddOne), &sum);
    TSKWAIT(tca);
    EXPECT_EQ(sum, round + 1);
    EXPECT_EQ(tca[0], 2);
    numbers.insert(tca[1]);
  }
  EXPECT_EQ(numbers.size(), 50u);
}

TYPED_TEST(CrayCTest, TskwaitReturnsForEveryWaiterTwiceAndAtOnceForGarbage) {
  using Word = TypeParam;
  Word event = 0, tca[2] = {2, 0};
  EVASGN(&event);
  std::function<void(int)> body = [&](int) { EVWAIT(&event); };
  TSKSTART(tca, AsRoutine(&CrayTaskBody), &body, 0L);
  EXPECT_EQ(TSKTEST(tca), 1);
  std::atomic<int> num_returned = 0;
  {
    CrayTasks<Word> waiters(4, [&](int) {
      TSKWAIT(tca);
      ++num_returned;
    });
    EXPECT_EQ(num_returned, 0);
    EVPOST(&event);
  }
  EXPECT_EQ(num_returned, 4);
  TSKWAIT(tca);
  EXPECT_EQ(TSKTEST(tca), 0);
  for (const Word garbage : {0, -1, 1'999'999'999}) {
    Word never_started[2] = {2, garbage};
    EXPECT_EQ(TSKTEST(never_started), 0);
    TSKWAIT(never_started);
  }
  EVREL(&event);
}

TYPED_TEST(CrayCTest, TskvalueIsTheUserValueAndZeroInTheInitialTask) {
  using Word = TypeParam;
  Word mine = 5, without = 5, with = 5;
  TSKVALUE(&mine);
  EXPECT_EQ(mine, 0);
  const auto read = [](Word* value) { TSKVALUE(value); };
  std::function<void(int)> body = [&](int task) {
    read(task == 0 ? &without : &with);
  };
  Word tca2[2] = {2, 0}, tca3[3] = {3, 0, -42};
  TSKSTART(tca2, AsRoutine(&CrayTaskBody), &body, 0L);
  TSKSTART(tca3, AsRoutine(&CrayTaskBody), &body, 1L);
  TSKWAIT(tca2);
  TSKWAIT(tca3);
  EXPECT_EQ(without, 0);
  EXPECT_EQ(with, -42);
}

}  // namespace
}  // namespace macrotask
