// Figure 3, spatial parallelism with redundant RMA [MSO93 section 2]: one
// synchronization less than Figure 2. One derivative evaluation; an iteration
// has two, PE and CE.
//
//     task 1          task 2     ...    task m^
//    [ CS_1 ]        [ CS_2 ]          [ CS_m ]     compute state
//    [ OCD_1 ]       [ OCD_2 ]         [ OCD_m ]    open-chain dynamics
//    =================== BARSYNC(m^) ===================
//    [ RMA ]         [ RMA ]           [ RMA ]      reference member
//    [ CCD_1 ]       [ CCD_2 ]         [ CCD_m ]    closed-chain dynamics
//
// Here each task k computes m/m^ chains, and RMA on its own copy of the
// reference member's state.

#include "integrators/task_structure.h"
#include "macrotask/barrier.h"

namespace integrators {
namespace {

class Figure3 final : public TaskStructure {
 public:
  Figure3(int chain_tasks, macrotask::WaitPolicy wait)
      : all_chains_(chain_tasks, wait) {}

  void Run(int /*i*/, int k, BlockTask& task) override {
    for (int block = 0; block < task.num_blocks(); ++block) {
      task.Predict();  // CS
      Evaluate(k, Phase::kPredicted, task);

      task.Correct();  // CS
      Evaluate(k, Phase::kCorrected, task);

      task.ShiftBlocks();
      if (task.Ended()) return;
    }
  }

 private:
  void Evaluate(int k, Phase phase, BlockTask& task) {
    task.Ocd(phase);      // OCD_k
    all_chains_.Sync(k);  // BARSYNC(m^)
    task.Rma(phase);      // RMA
    task.Ccd(phase);      // CCD_k
  }

  macrotask::Barrier all_chains_;
};

}  // namespace

std::unique_ptr<TaskStructure> MakeFigure3(int chain_tasks,
                                           macrotask::WaitPolicy wait) {
  return std::make_unique<Figure3>(chain_tasks, wait);
}

}  // namespace integrators
