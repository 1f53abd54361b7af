#pragma once

#include <ostream>

#include "bench/predict/program.h"

namespace bench::predict {

// For the message of a test that fails.
inline void PrintTo(const Step& step, std::ostream* out) {
  *out << "{kind " << static_cast<int>(step.kind) << ", " << Name(step.block)
       << ", object " << step.object << ", " << step.seconds << " + "
       << step.busy << " s}";
}

}  // namespace bench::predict
