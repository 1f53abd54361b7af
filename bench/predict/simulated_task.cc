#include "bench/predict/simulated_task.h"

namespace bench::predict {
namespace {

// The value of a spread that the share `u` of all do not exceed.
double Quantile(const Spread& spread, double u) {
  const double place = u * static_cast<double>(spread.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  if (below + 1 >= spread.size()) return spread.back();
  const double weight = place - static_cast<double>(below);
  return spread[below] + weight * (spread[below + 1] - spread[below]);
}

double Vary(double seconds, const Spread& spread, std::mt19937_64* random) {
  if (spread.empty() || seconds == 0) return seconds;
  // 53 bits, as a double has them: the same everywhere.
  const double u = static_cast<double>((*random)() >> 11) * 0x1p-53;
  return seconds * Quantile(spread, u);
}

}  // namespace

double SimulatedTask::Draw(const Step& step,
                           const std::array<Spread, kNumBlocks>& spreads) {
  const auto spread_of = [&](Block block) -> const Spread& {
    return spreads[static_cast<std::size_t>(block)];
  };
  const double seconds = Vary(step.seconds, spread_of(step.block), &random);
  return seconds + Vary(step.busy, spread_of(Block::kOther), &random);
}

}  // namespace bench::predict
