#pragma once

#include <string>

namespace bench {

// A line on the terminal that says what is being done; silent when the standard
// error is no terminal.
class Progress {
 public:
  Progress();
  ~Progress();  // clears the line
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  // `done` of `all`: a part of `what`.
  void Show(const std::string& what, int done, int all);

 private:
  bool terminal_;
};

}  // namespace bench
