// Figure 2, spatial parallelism with serial RMA [MSO93 section 2]. One
// derivative evaluation; an iteration has two, PE and CE.
//
//     task 1          task 2     ...    task m^
//    [ CS_1 ]        [ CS_2 ]          [ CS_m ]     compute state
//    [ OCD_1 ]       [ OCD_2 ]         [ OCD_m ]    open-chain dynamics
//    =================== BARSYNC(m^) ===================
//    [ RMA ]             |                 |        reference member
//    ( EVPOST ) - - -> ( EVWAIT )  - ->  ( EVWAIT )
//    [ CCD_1 ]       [ CCD_2 ]         [ CCD_m ]    closed-chain dynamics
//
// Here each task k computes m/m^ chains. Task 1 alone keeps the state of the
// reference member.

#include <array>

#include "integrators/task_structure.h"
#include "macrotask/barrier.h"
#include "macrotask/event.h"

namespace integrators {
namespace {

class Figure2 final : public TaskStructure {
 public:
  Figure2(int chain_tasks, macrotask::WaitPolicy wait)
      : all_chains_(chain_tasks, wait),
        accelerations_posted_{macrotask::Event(wait), macrotask::Event(wait)} {}

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
    macrotask::Event& posted = accelerations_posted_[static_cast<int>(phase)];
    macrotask::Event& other =
        accelerations_posted_[1 - static_cast<int>(phase)];

    task.Ocd(phase);      // OCD_k
    all_chains_.Sync(k);  // BARSYNC(m^)
    if (k == 0) {
      // All tasks have come from their wait for the evaluation before.
      other.Clear();    // EVCLEAR
      task.Rma(phase);  // RMA
      posted.Post();    // EVPOST
    } else {
      posted.Wait();  // EVWAIT
    }
    task.Ccd(phase);  // CCD_k
  }

  macrotask::Barrier all_chains_;
  std::array<macrotask::Event, 2> accelerations_posted_;  // by phase
};

}  // namespace

std::unique_ptr<TaskStructure> MakeFigure2(int chain_tasks,
                                           macrotask::WaitPolicy wait) {
  return std::make_unique<Figure2>(chain_tasks, wait);
}

}  // namespace integrators
