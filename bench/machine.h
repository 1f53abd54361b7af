#pragma once

#include <string>

namespace bench {

// What the figures of a table were measured on and with.
struct Machine {
  std::string cpu;  // model name
  int processors;   // that this process may use
  std::string kernel;
  std::string compiler;
  std::string flags;
  std::string version;  // of this program
  std::string git_hash;
};

Machine DescribeMachine();

}  // namespace bench
