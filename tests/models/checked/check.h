#pragma once

// How a program of a few tasks is checked.

#include <functional>
#include <initializer_list>
#include <ostream>
#include <streambuf>
#include <string>
#include <vector>

#include "tests/models/checked/orders.h"

namespace macrotask::checked {

// Text that relacy writes while the heap is in its hands: a string that grew
// then could not be freed afterwards.
class FixedText : public std::streambuf {
 public:
  FixedText() { setp(text_, text_ + sizeof text_); }
  std::string text() const { return {pbase(), pptr()}; }

 private:
  char text_[1 << 16];
};

// Runs `Program` in so many ways, chosen at random but always the same. Returns
// what went wrong, or "".
template <typename Program>
std::string Search() {
  FixedText text;
  std::ostream said(&text);
  rl::test_params params;
  params.iteration_count = Program::kNumRuns;
  params.output_stream = &said;
  params.progress_stream = &said;
  params.execution_depth_limit = 4000;
  if (rl::simulate<Program>(params)) return "";
  // Relacy says first the name of the program, then what went wrong, and then
  // how it came to that.
  return in_force ? rl::test_result_str(params.test_result) : text.text();
}

// Runs each of `programs`, which must find nothing; then all of them for every
// weakening of an order in the source, which one of them must find, but for
// those in `survivors`. Returns the exit code.
int Check(std::initializer_list<std::function<std::string()>> programs,
          const std::vector<std::string>& survivors);

}  // namespace macrotask::checked
