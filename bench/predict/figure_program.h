#pragma once

#include <vector>

#include "bench/predict/program.h"
#include "integrators/block_method.h"
#include "integrators/block_run.h"
#include "integrators/task_structure.h"

namespace bench::predict {

// One way to run an integration.
struct FigureCase {
  integrators::BlockMethod method;
  integrators::Figure figure = integrators::Figure::kFigure8;
  integrators::Partition partition = {};
  int num_chains = 4;
  int num_steps = 0;
};

// What the tasks of a figure do, without what it costs: all kCompute steps take
// 0 s. Read off the history trace of a run of the figure itself, with a system
// that computes nothing, on logical tasks of this machine, whatever the figure
// will be asked of; so there is no second copy of the figures. Three blocks are
// run; the middle one is the body of the programs.
//
// Task (i, k) is i m^ + k. Throws as integrators::Integration does.
// Not thread-safe, as the history trace is one for the whole program; throws
// std::invalid_argument, one sentence, if it is in use.
Program ReadFigure(const FigureCase& figure_case);

// Gives its name to what a run of a figure computed without one: what comes
// before OCD is CS, before a post the shift, first in the first task the start.
// The rest, such as between a barrier and an EVCLEAR, is next to nothing and
// left out. Requires: a system that leaves marks.
std::vector<Step> NameBlocks(const std::vector<Step>& steps, bool first_task);

// Throws std::invalid_argument, one sentence, if the history trace records
// already; else makes its rings large enough for figures of so many tasks, and
// no larger, so that they stay in the cache. Before anything is recorded.
void PrepareTrace(int most_tasks);

}  // namespace bench::predict
