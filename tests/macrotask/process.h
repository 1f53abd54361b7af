#pragma once

#include <gtest/gtest.h>

#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

// For tests of what a whole program does, each in a process of its own.

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define MACROTASK_SANITIZED 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define MACROTASK_SANITIZED 1
#endif
#endif

#if defined(__SANITIZE_THREAD__)
// Otherwise each process sleeps for a second at its end.
extern "C" __attribute__((used)) inline const char* __tsan_default_options() {
  return "atexit_sleep_ms=0";
}
#endif

namespace macrotask {

#ifdef MACROTASK_SANITIZED
inline constexpr bool kSanitized = true;
#else
inline constexpr bool kSanitized = false;
#endif

// Makes the death tests of a suite start fresh processes, rather than fork this
// one and its pthreads.
template <typename Suite>
class InOwnProcess : public Suite {
 protected:
  InOwnProcess() { testing::FLAGS_gtest_death_test_style = "threadsafe"; }
};

// The regular expression that matches this text and nothing else.
inline std::string Exactly(const std::string& text) {
  std::string expression = "^";
  for (const char c : text) {
    if (std::ispunct(static_cast<unsigned char>(c)) != 0 && c != '\'' &&
        c != ',' && c != '-' && c != ':' && c != '_') {
      expression += '\\';
    }
    expression += c;
  }
  return expression + "$";
}

// A directory of this test program, also in the processes that it starts.
// Removed when the program ends.
inline std::string TemporaryDirectory() {
  static const char* const kVariable = "MACROTASK_TEST_DIRECTORY";
  static const std::string path = [] {
    if (const char* const given = std::getenv(kVariable)) {
      return std::string(given);
    }
    std::string made = testing::TempDir() + "macrotask_test_XXXXXX";
    if (mkdtemp(made.data()) == nullptr) std::abort();
    setenv(kVariable, made.c_str(), 1);
    std::atexit([] { std::filesystem::remove_all(std::getenv(kVariable)); });
    return made;
  }();
  return path;
}

inline std::string Contents(const std::string& path) {
  std::ifstream file(path);
  return std::string(std::istreambuf_iterator<char>(file), {});
}

}  // namespace macrotask
