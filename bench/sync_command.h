#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "bench/sync_plan.h"

namespace bench {

// macrotask sync
class SyncCommand {
 public:
  static constexpr const char* kDescription =
      "Measure what synchronization costs: barriers, events, locks and tasks, "
      "their peers\nand the limits of this machine, in turn; or "
      "--break-even, how small the work\nbetween two barriers may be; or "
      "--calibrate, how long a wait should spin";

  void Add(CLI::App* app);
  void Run() const;

 private:
  void CheckOutputs() const;
  void Calibrate() const;

  SyncAxes axes_;
  int hold_time_us_ = 50;
  int repetitions_ = 20;
  bool break_even_ = false;
  bool calibrate_ = false;
  std::string csv_, json_;
};

}  // namespace bench
