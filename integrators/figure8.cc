// Figure 8, combined spatial and temporal parallelism [MSO93 section 4]. One
// iteration; tasks (block point, chain):
//
//     (1,1)   (1,2) ... (1,m)  |  (2,1)   (2,2) ... (2,m)  |  ...  (p,m)
//    [ CS ]  [ CS ]    [ CS ]  | [ CS ]  [ CS ]    [ CS ]  |        predict
//    [ OCD ] [ OCD ]   [ OCD ] | [ OCD ] [ OCD ]   [ OCD ] |
//    ===== BARSYNC(m^) ======= | ===== BARSYNC(m^) ======= |  ...
//    [ RMA ] [ RMA ]   [ RMA ] | [ RMA ] [ RMA ]   [ RMA ] |
//    [ CCD ] [ CCD ]   [ CCD ] | [ CCD ] [ CCD ]   [ CCD ] |
//    == BARSYNC(p^): (1,1) (2,1) ... (p,1); (1,2) (2,2) ... (p,2); ... ==
//    [ CS ]  [ CS ]    [ CS ]  | [ CS ]  [ CS ]    [ CS ]  |        correct
//    [ OCD ] [ OCD ]   [ OCD ] | [ OCD ] [ OCD ]   [ OCD ] |
//    ===== BARSYNC(m^) ======= | ===== BARSYNC(m^) ======= |  ...
//    [ RMA ] [ RMA ]   [ RMA ] | [ RMA ] [ RMA ]   [ RMA ] |
//    [ CCD ] [ CCD ]   [ CCD ] | [ CCD ] [ CCD ]   [ CCD ] |
//    == BARSYNC(p^): the points of each chain ============================
//    [shift] [shift]   [shift] |    |       |         |    |
//    EVPOST  EVPOST    EVPOST  -> EVWAIT  EVWAIT    EVWAIT -> ...
//
// The temporal barriers are broken apart: each joins only the tasks of the same
// chains, because the integration of a chain needs only its own values at all
// block points; the shift is done per chain for the same reason. Here task (i,
// k) computes m/m^ chains at p/p^ points.

#include <deque>

#include "integrators/task_structure.h"
#include "macrotask/barrier.h"
#include "macrotask/event.h"

namespace integrators {
namespace {

class Figure8 final : public TaskStructure {
 public:
  Figure8(Partition partition, macrotask::WaitPolicy wait) {
    for (int i = 0; i < partition.integration_tasks; ++i) {
      chains_of_point_.emplace_back(partition.chain_tasks, wait);
    }
    for (int k = 0; k < partition.chain_tasks; ++k) {
      points_of_chain_.emplace_back(partition.integration_tasks, wait);
      blocks_shifted_.emplace_back(wait);
    }
  }

  void Run(int i, int k, BlockTask& task) override {
    macrotask::Barrier& chains = chains_of_point_[static_cast<std::size_t>(i)];
    macrotask::Barrier& points = points_of_chain_[static_cast<std::size_t>(k)];
    macrotask::Event& shifted = blocks_shifted_[static_cast<std::size_t>(k)];

    for (int block = 0; block < task.num_blocks(); ++block) {
      task.Predict();               // CS (predict)
      task.Ocd(Phase::kPredicted);  // OCD
      chains.Sync(k);               // BARSYNC(m^)
      task.Rma(Phase::kPredicted);  // RMA
      task.Ccd(Phase::kPredicted);  // CCD
      points.Sync(i);               // BARSYNC(p^)
      // All tasks of the chain have come from their wait for the shift before.
      if (i == 0) shifted.Clear();  // EVCLEAR

      task.Correct();               // CS (correct)
      task.Ocd(Phase::kCorrected);  // OCD
      chains.Sync(k);               // BARSYNC(m^)
      task.Rma(Phase::kCorrected);  // RMA
      task.Ccd(Phase::kCorrected);  // CCD
      points.Sync(i);               // BARSYNC(p^)

      if (i == 0) {
        task.ShiftBlocks();  // shift
        shifted.Post();      // EVPOST
      } else {
        shifted.Wait();  // EVWAIT
      }
      if (task.Ended()) return;
    }
  }

 private:
  // Deques, because what tasks wait at cannot move.
  std::deque<macrotask::Barrier> chains_of_point_;  // (p^)
  std::deque<macrotask::Barrier> points_of_chain_;  // (m^)
  std::deque<macrotask::Event> blocks_shifted_;     // (m^)
};

}  // namespace

std::unique_ptr<TaskStructure> MakeFigure8(Partition partition,
                                           macrotask::WaitPolicy wait) {
  return std::make_unique<Figure8>(partition, wait);
}

}  // namespace integrators
