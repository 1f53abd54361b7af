#include "bench/trace_names.h"

#include <fmt/format.h>

#include <stdexcept>

#include "macrotask/trace_text.h"

namespace bench {
namespace {

using macrotask::TraceAction;

std::string KnownActions() {
  std::string names;
  for (int number = 1; number < macrotask::kFirstUserAction; ++number) {
    const auto name = Name(static_cast<TraceAction>(number));
    if (!name.empty()) names += fmt::format("{}, ", name);
  }
  return names + fmt::format("user {} to user {}", macrotask::kFirstUserAction,
                             macrotask::kLastUserAction);
}

}  // namespace

TraceAction ActionCalled(const std::string& text) {
  if (const auto action = macrotask::ParseTraceAction(text)) return *action;
  for (int number = macrotask::kFirstUserAction;
       number <= macrotask::kLastUserAction; ++number) {
    const auto action = static_cast<TraceAction>(number);
    if (ActionText(action) == text) return action;
  }
  throw std::invalid_argument("unknown --action '" + text +
                              "': expected one of " + KnownActions());
}

}  // namespace bench
