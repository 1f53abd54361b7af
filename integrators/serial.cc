// The serial program: Figure 8 with one task, nobody to wait for.

#include "integrators/task_structure.h"

namespace integrators {
namespace {

class Serial final : public TaskStructure {
 public:
  void Run(int /*i*/, int /*k*/, BlockTask& task) override {
    for (int block = 0; block < task.num_blocks(); ++block) {
      task.Predict();
      task.Ocd(Phase::kPredicted);
      task.Rma(Phase::kPredicted);
      task.Ccd(Phase::kPredicted);

      task.Correct();
      task.Ocd(Phase::kCorrected);
      task.Rma(Phase::kCorrected);
      task.Ccd(Phase::kCorrected);

      task.ShiftBlocks();
      if (task.Ended()) return;
    }
  }
};

}  // namespace

std::unique_ptr<TaskStructure> MakeSerial() {
  return std::make_unique<Serial>();
}

}  // namespace integrators
