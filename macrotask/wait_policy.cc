#include "macrotask/wait_policy.h"

#include "macrotask/placement.h"

namespace macrotask {

WaitPolicy WaitPolicy::For(int num_tasks) const {
  if (kind != WaitKind::kAuto) return *this;
  return {num_tasks > NumProcessors() ? WaitKind::kLogical : WaitKind::kHold,
          hold_time};
}

std::string_view Name(WaitKind kind) {
  switch (kind) {
    case WaitKind::kAuto:
      return "auto";
    case WaitKind::kBlock:
      return "block";
    case WaitKind::kSpin:
      return "spin";
    case WaitKind::kHold:
      return "hold";
    case WaitKind::kLogical:
      return "logical";
  }
  return "unknown";
}

std::optional<WaitKind> ParseWaitKind(std::string_view name) {
  for (WaitKind kind : {WaitKind::kAuto, WaitKind::kBlock, WaitKind::kSpin,
                        WaitKind::kHold, WaitKind::kLogical}) {
    if (name == Name(kind)) return kind;
  }
  return std::nullopt;
}

}  // namespace macrotask
