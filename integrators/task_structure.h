#pragma once

#include <memory>
#include <string_view>

#include "integrators/block_run.h"
#include "integrators/block_task.h"
#include "macrotask/wait_policy.h"

namespace integrators {

// Who waits for whom: one of the paper's figures.
enum class Figure { kSerial, kFigure2, kFigure3, kFigure7, kFigure8 };

std::string_view Name(Figure figure);  // "serial", "figure2", ...

// Whether the figure computes RMA once or in every chain task.
RmaSharing RmaSharingOf(Figure figure);

// The tasks of one run: their barriers and events, and what each of them does
// from the first block to the last.
class TaskStructure {
 public:
  virtual ~TaskStructure() = default;

  // The body of task (i, k), both counted from 0. Called once by each of the
  // m^ x p^ tasks, at the same time.
  virtual void Run(int i, int k, BlockTask& task) = 0;
};

// Throws std::invalid_argument, one sentence, if the figure cannot have this
// partition: Figures 2 and 3 are spatial (p^ = 1), Figure 7 is temporal (m^ =
// 1), the serial program has one task.
std::unique_ptr<TaskStructure> MakeTaskStructure(Figure figure,
                                                 Partition partition,
                                                 macrotask::WaitPolicy wait);

// One constructor a figure, each in its own source beside the figure.
std::unique_ptr<TaskStructure> MakeSerial();
std::unique_ptr<TaskStructure> MakeFigure2(int chain_tasks,
                                           macrotask::WaitPolicy wait);
std::unique_ptr<TaskStructure> MakeFigure3(int chain_tasks,
                                           macrotask::WaitPolicy wait);
std::unique_ptr<TaskStructure> MakeFigure7(int integration_tasks,
                                           macrotask::WaitPolicy wait);
std::unique_ptr<TaskStructure> MakeFigure8(Partition partition,
                                           macrotask::WaitPolicy wait);

}  // namespace integrators
