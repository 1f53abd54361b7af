#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "bench/predict/machine.h"
#include "bench/predict/simulation.h"
#include "dynamics/closed_chain_system.h"
#include "macrotask/wait_policy.h"

namespace bench {

// macrotask predict
class PredictCommand {
 public:
  static constexpr const char* kDescription =
      "Predict the run times of machines that are not there, by simulating the "
      "tasks:\nTables 1 and 2 for any number of processors, a program of your "
      "own from its history\ntrace, or how good the predictions are";

  void Add(CLI::App* app);
  void Run() const;

 private:
  void AddOutputs(CLI::App* app);
  void CheckOutputs() const;
  predict::MachineModel GetMachine() const;
  std::string Table(const predict::MachineModel& machine) const;
  std::string OfTrace(const predict::MachineModel& machine) const;
  void Validate() const;

  std::vector<int> processors_ = {1, 2, 4, 8, 16};
  std::vector<std::string> methods_ = {"B4PC5", "B2PC5", "B1PC5"};
  int num_chains_ = 4;
  int lanes_ = 0;  // the machine's widest
  macrotask::WaitKind wait_ = macrotask::WaitKind::kAuto;
  int hold_time_us_ = 50;
  double work_us_ = 0;
  int seed_ = 1;
  int replications_ = 40;
  bool dedicated_ = false;
  bool validate_ = false;
  int rounds_ = 40;
  predict::TaskPlacement placement_ = predict::TaskPlacement::kFree;
  std::string machine_, write_machine_, trace_, csv_;
};

// macrotask tune
class TuneCommand {
 public:
  static constexpr const char* kDescription =
      "Find the fastest way to run the lift on this machine: measure what "
      "things cost,\npredict every method, partition, width of lanes and way "
      "to wait, run the best three\nand the best serial one";

  void Add(CLI::App* app);
  void Run() const;

 private:
  std::vector<std::string> methods_ = {"B4PC5", "B2PC5", "B1PC5"};
  int hold_time_us_ = 50;
  int repetitions_ = 200;
  std::string write_;
};

}  // namespace bench
