#pragma once

#include <string>
#include <vector>

namespace bench {

// A table of text that pastes as Markdown and reads aligned in a terminal, or
// as CSV.
class TextTable {
 public:
  explicit TextTable(std::vector<std::string> header);

  // As many cells as the header has.
  void AddRow(std::vector<std::string> row);

  std::string Markdown() const;
  std::string Csv() const;

 private:
  std::vector<std::vector<std::string>> rows_;  // the header first
};

}  // namespace bench
