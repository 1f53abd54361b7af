#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "bench/trace_filter.h"
#include "bench/trace_reports.h"

namespace bench {

// macrotask trace FILE
class TraceCommand {
 public:
  static constexpr const char* kDescription =
      "Read a history trace, as MTDUMP did: who ran, who waited for what, and "
      "for whom.\nTimes are microseconds since recording was switched on";

  void Add(CLI::App* app);
  void Run() const;

 private:
  void CheckOutputs() const;

  std::string file_;
  std::vector<TraceReport> reports_;
  TraceFilter filter_;
  std::string csv_, perfetto_;
};

}  // namespace bench
