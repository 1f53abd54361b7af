#include "macrotask/futex.h"

#include <linux/futex.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <bit>
#include <cstddef>
#include <limits>

namespace macrotask {
namespace {

static_assert(sizeof(std::atomic<std::uint64_t>) == sizeof(std::uint64_t),
              "the system looks at the bare word");

void Futex(const std::atomic<std::uint64_t>& word, int operation,
           std::uint32_t value) {
  constexpr std::size_t kLowerHalf =
      std::endian::native == std::endian::little ? 0 : 1;
  const auto* const half =
      reinterpret_cast<const std::uint32_t*>(&word) + kLowerHalf;
  // What can go wrong (interrupted, the word has changed) is a wake-up for no
  // reason to those who call.
  syscall(SYS_futex, half, operation, value, nullptr, nullptr, 0);
}

}  // namespace

void FutexWait(const std::atomic<std::uint64_t>& word, std::uint32_t seen) {
  Futex(word, FUTEX_WAIT_PRIVATE, seen);
}

void FutexWakeAll(const std::atomic<std::uint64_t>& word) {
  constexpr auto kAll =
      static_cast<std::uint32_t>(std::numeric_limits<int>::max());
  Futex(word, FUTEX_WAKE_PRIVATE, kAll);
}

}  // namespace macrotask
