#include "macrotask/wait_policy.h"

namespace macrotask {

std::string_view Name(WaitKind kind) {
  switch (kind) {
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
  for (WaitKind kind : {WaitKind::kBlock, WaitKind::kSpin, WaitKind::kHold,
                        WaitKind::kLogical}) {
    if (name == Name(kind)) return kind;
  }
  return std::nullopt;
}

}  // namespace macrotask
