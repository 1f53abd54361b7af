#include "bench/gains.h"

namespace bench {

std::vector<double> T(const TableRow& row) {
  std::vector<double> seconds = row.seconds;
  for (double& s : seconds) s *= row.scale;
  return seconds;
}

double MedianT(const TableRow& row) { return Median(T(row)); }

Gain GainOf(const std::vector<double>& before,
            const std::vector<double>& after) {
  const std::vector<double> ratios = Ratios(before, after);
  return {Median(ratios), MedianInterval(ratios)};
}

Gain SpeedupOf(const TableRow& serial, const TableRow& row) {
  return GainOf(serial.seconds, row.seconds);
}

double StepSpeedup(const Reproduction& reproduction, int block_size) {
  return SweepOf(reproduction, 1).steps_at_target /
         SweepOf(reproduction, block_size).steps_at_target;
}
double ClockSpeedup(const LaneTables& tables, int block_size) {
  return GainOf(T(SerialRow(tables, 1)), T(SerialRow(tables, block_size)))
      .value;
}

}  // namespace bench
