#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include "bench/predict/program.h"
#include "bench/predict/simulation.h"

namespace bench::predict {

// Internal: follows the steps of a task.
class StepCursor {
 public:
  explicit StepCursor(const TaskProgram& task) : task_(&task) { Settle(); }

  bool at_end() const { return part_ == 3; }
  const Step& step() const { return (*steps())[index_]; }
  void Next() {
    ++index_;
    Settle();
  }

 private:
  const std::vector<Step>* steps() const {
    return part_ == 0 ? &task_->head : part_ == 1 ? &task_->body : &task_->tail;
  }
  bool NoBodyIsLeft() const { return part_ == 1 && turn_ >= task_->num_bodies; }
  // Goes on to the next part, or the next body, where one is through.
  void Settle() {
    while (part_ < 3 && (index_ == steps()->size() || NoBodyIsLeft())) {
      const bool again = part_ == 1 && !NoBodyIsLeft() &&
                         ++turn_ < task_->num_bodies && index_ > 0;
      if (!again) ++part_;
      index_ = 0;
    }
  }

  const TaskProgram* task_;
  int part_ = 0;  // head, body, tail, nothing
  long turn_ = 0;
  std::size_t index_ = 0;
};

// Internal: a task of a simulation.
struct SimulatedTask {
  SimulatedTask(const TaskProgram& program, std::uint64_t seed)
      : cursor(program), random(seed) {}

  // What a kCompute step takes this time (s).
  double Draw(const Step& step, const std::array<Spread, kNumBlocks>& spreads);

  StepCursor cursor;
  std::mt19937_64 random;  // its own, so that nobody's order matters to it
  TaskTimes times;
  double waits_since = 0;
  double ready_since = 0;
  bool complete = false;
  std::vector<int> joiners;
};

}  // namespace bench::predict
