#include <gtest/gtest.h>

#include "integrators/integration.h"
#include "tests/support/allocation_counter.h"
#include "tests/support/model_system.h"

namespace integrators {
namespace {

long AllocationsOfRun(const IntegrationOptions& options) {
  const support::ModelSystem model(4);
  Integration integration(model, options);
  const auto initial = model.Solution(0);
  integration.Run(initial);  // the first one starts pthreads
  const long before = support::NumAllocations();
  integration.Run(initial);
  return support::NumAllocations() - before;
}

// Runs of different lengths allocate the same: the steps allocate nothing.
TEST(Allocation, DoesNotDependOnTheNumberOfSteps) {
  for (const Figure figure :
       {Figure::kSerial, Figure::kFigure2, Figure::kFigure3, Figure::kFigure7,
        Figure::kFigure8}) {
    IntegrationOptions options;
    options.method = B4PC5();
    options.step = 0.001;
    options.figure = figure;
    if (figure == Figure::kFigure2 || figure == Figure::kFigure3) {
      options.partition = {2, 1};
    } else if (figure == Figure::kFigure7) {
      options.partition = {1, 2};
    } else if (figure == Figure::kFigure8) {
      options.partition = {2, 2};
    }
    options.num_steps = 44;
    const long few = AllocationsOfRun(options);
    options.num_steps = 844;
    EXPECT_EQ(AllocationsOfRun(options), few) << Name(figure);
    EXPECT_GT(few, 0);  // the counter counts
  }
}

}  // namespace
}  // namespace integrators
