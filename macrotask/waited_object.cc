#include "macrotask/waited_object.h"

#include <atomic>

namespace macrotask {

std::string_view Name(ObjectKind kind) {
  switch (kind) {
    case ObjectKind::kBarrier:
      return "barrier";
    case ObjectKind::kEvent:
      return "event";
    case ObjectKind::kLock:
      return "lock";
    case ObjectKind::kTask:
      return "task";
    case ObjectKind::kNone:
      break;
  }
  return "";
}

std::uint32_t NextNumber(ObjectKind kind) {
  static constinit std::atomic<std::uint32_t> last[5] = {};
  return last[static_cast<int>(kind)].fetch_add(1, std::memory_order_relaxed) +
         1;
}

}  // namespace macrotask
