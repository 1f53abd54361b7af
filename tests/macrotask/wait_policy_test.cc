#include "macrotask/wait_policy.h"

#include <gtest/gtest.h>

#include <cerrno>
#include <chrono>
#include <cstddef>
#include <optional>
#include <system_error>

#include "macrotask/cache_line.h"
#include "macrotask/check.h"
#include "macrotask/placement.h"

namespace macrotask {
namespace {

TEST(WaitPolicyTest, DefaultSuitsTheNumberOfTasks) {
  EXPECT_EQ(WaitPolicy().For(NumProcessors()), WaitPolicy::Hold());
  EXPECT_EQ(WaitPolicy().For(NumProcessors() + 1), WaitPolicy::Logical());
  EXPECT_EQ(WaitPolicy::Block().For(NumProcessors() + 1), WaitPolicy::Block());
}

TEST(WaitPolicyTest, PoliciesOfOtherKindsOrTimesDiffer) {
  EXPECT_NE(WaitPolicy::Hold(), WaitPolicy::Hold(std::chrono::seconds(1)));
  EXPECT_NE(WaitPolicy::Block(), WaitPolicy::Spin());
}

TEST(WaitKindTest, NamesAreReadBack) {
  for (WaitKind kind : {WaitKind::kAuto, WaitKind::kBlock, WaitKind::kSpin,
                        WaitKind::kHold, WaitKind::kLogical}) {
    EXPECT_EQ(ParseWaitKind(Name(kind)), kind);
  }
  EXPECT_EQ(ParseWaitKind("hold"), WaitKind::kHold);
}

TEST(WaitKindTest, OtherNamesAreNone) {
  for (const char* name : {"", "Hold", "hold ", "blocking"}) {
    EXPECT_EQ(ParseWaitKind(name), std::nullopt) << name;
  }
}

TEST(CheckPthreadTest, NamesTheCallAndTheError) {
  EXPECT_NO_THROW(CheckPthread(0, "pthread_create"));
  try {
    CheckPthread(EAGAIN, "pthread_create");
    FAIL() << "nothing was thrown";
  } catch (const std::system_error& error) {
    EXPECT_EQ(error.code(), std::errc::resource_unavailable_try_again);
    EXPECT_STREQ(error.what(),
                 "pthread_create: Resource temporarily unavailable");
  }
}

TEST(CacheAlignedTest, ElementsOfAnArrayShareNoLine) {
  CacheAligned<int> slots[2];
  EXPECT_EQ(
      reinterpret_cast<char*>(&*slots[1]) - reinterpret_cast<char*>(&*slots[0]),
      static_cast<std::ptrdiff_t>(kCacheLine));
}

}  // namespace
}  // namespace macrotask
