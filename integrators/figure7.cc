// Figure 7, temporal parallelism [MSO93 section 3]. One iteration: a block of p
// points in time.
//
//     task 1           task 2      ...    task p^
//    [ PE_1 ]         [ PE_2 ]           [ PE_p ]    predict, evaluate
//    ============= synchronization barrier =============
//    [ CE_1 ]         [ CE_2 ]           [ CE_p ]    correct, evaluate
//    ============= synchronization barrier =============
//    [ shift blocks ]     |                  |
//    ( EVPOST ) - - -> ( EVWAIT )   - ->  ( EVWAIT )
//
// Here each task i computes p/p^ points of the whole system.

#include "integrators/task_structure.h"
#include "macrotask/barrier.h"
#include "macrotask/event.h"

namespace integrators {
namespace {

class Figure7 final : public TaskStructure {
 public:
  Figure7(int integration_tasks, macrotask::WaitPolicy wait)
      : all_points_(integration_tasks, wait), blocks_shifted_(wait) {}

  void Run(int i, int /*k*/, BlockTask& task) override {
    for (int block = 0; block < task.num_blocks(); ++block) {
      task.Predict();  // PE_i
      Evaluate(Phase::kPredicted, task);
      all_points_.Sync(i);  // BARSYNC(p^)
      // All tasks have come from their wait for the shift before.
      if (i == 0) blocks_shifted_.Clear();  // EVCLEAR

      task.Correct();  // CE_i
      Evaluate(Phase::kCorrected, task);
      all_points_.Sync(i);  // BARSYNC(p^)

      if (i == 0) {
        task.ShiftBlocks();      // shift blocks
        blocks_shifted_.Post();  // EVPOST
      } else {
        blocks_shifted_.Wait();  // EVWAIT
      }
      if (task.Ended()) return;
    }
  }

 private:
  static void Evaluate(Phase phase, BlockTask& task) {
    task.Ocd(phase);
    task.Rma(phase);
    task.Ccd(phase);
  }

  macrotask::Barrier all_points_;
  macrotask::Event blocks_shifted_;
};

}  // namespace

std::unique_ptr<TaskStructure> MakeFigure7(int integration_tasks,
                                           macrotask::WaitPolicy wait) {
  return std::make_unique<Figure7>(integration_tasks, wait);
}

}  // namespace integrators
