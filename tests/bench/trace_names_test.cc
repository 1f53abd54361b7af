#include "bench/trace_names.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "macrotask/trace_text.h"

namespace bench {
namespace {

using Action = macrotask::TraceAction;

TEST(ActionCalled, UnderstandsActionText) {
  for (int number = 1; number <= macrotask::kLastUserAction; ++number) {
    const auto action = static_cast<Action>(number);
    const std::string text = ActionText(action);
    if (text.starts_with("action ")) continue;
    EXPECT_EQ(ActionCalled(text), action) << text;
  }
}

TEST(ActionCalled, UnknownNameThrowsWithTheExpectedOnes) {
  for (const char* name :
       {"BARSINK", "user 64", "user 129", "action 129", ""}) {
    try {
      ActionCalled(name);
      ADD_FAILURE() << name;
    } catch (const std::invalid_argument& error) {
      const std::string text = error.what();
      EXPECT_EQ(text.find("unknown --action '" + std::string(name) +
                          "': expected one of TSKSTART, task begins"),
                0u);
      EXPECT_TRUE(text.ends_with("TSKTUNE, user 65 to user 128")) << text;
    }
  }
}

}  // namespace
}  // namespace bench
