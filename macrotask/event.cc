#include "macrotask/event.h"

#include <cstdint>

namespace macrotask {
namespace {

bool IsPosted(std::uint64_t epoch) { return epoch % 2 == 1; }

}  // namespace

void Event::Wait() {
  // To wait for the epoch to pass, rather than for the event to be posted, is
  // what makes Post() and Clear() in a row release a task that looked at
  // neither in between.
  const std::uint64_t seen = epoch_.Read();
  if (!IsPosted(seen)) epoch_.AwaitPast(seen, policy_);
}

bool Event::Test() const { return IsPosted(epoch_.Read()); }

}  // namespace macrotask
