// From machines to tables: the Cray's against the paper, limits, the rule.

#include "bench/predict/prediction.h"

#include <gtest/gtest.h>

#include <cmath>

#include "bench/predict/machine_file.h"
#include "bench/predict/prediction_table.h"
#include "bench/predict/tuning.h"
#include "bench/predict/validation.h"

namespace bench::predict {
namespace {

MachineModel Cray() {
  return ReadMachine(SOURCE_DIR "/bench/machines/cray-ymp8-864.json");
}

const std::vector<MethodSweep>& Sweeps() {
  static const auto sweeps = SweepMethods(
      {integrators::B4PC5(), integrators::B2PC5(), integrators::B1PC5()},
      [] { return dynamics::PumaLift(); }, [](const char*, int, int) {});
  return sweeps;
}

TableOptions OneLane(std::vector<int> processors) {
  TableOptions options;
  options.processors = std::move(processors);
  options.num_lanes = 1;
  return options;
}

std::vector<PredictedRow> CrayRows(std::vector<int> processors,
                                   bool dedicated = false) {
  MachineModel machine = Cray();
  if (dedicated) machine.slowdowns.clear();
  Predictor predictor(machine, {.replications = 1});
  return PredictRows(OneLane(std::move(processors)), Sweeps(), &predictor);
}

TEST(CrayMachine, IsWithinFivePercentOfEveryRowOfThePaper) {
  int compared = 0;
  for (const PredictedRow& row : CrayRows({1, 4, 8})) {
    if (row.paper == nullptr) continue;
    ++compared;
    EXPECT_NEAR(row.S_p.value / row.paper->S_p, 1, 0.05)
        << ConfigurationText(row);
    EXPECT_NEAR(row.S_T.value / row.paper->S_T, 1, 0.05)
        << ConfigurationText(row);
  }
  EXPECT_EQ(compared, 12);
}

// Three figures of the file are solved from three rows: so these fit.
TEST(CrayMachine, FitsTheRowsThatItIsCalibratedOn) {
  for (const PredictedRow& row : CrayRows({4})) {
    if (row.paper == nullptr || row.method.block_size != 4) continue;
    EXPECT_NEAR(row.S_p.value / row.paper->S_p, 1, 0.002)
        << ConfigurationText(row);
  }
}

TEST(CrayMachine, GainsFromB4PC5WithSixteenProcessors) {
  const auto rows = CrayRows({8, 16}, true);
  std::vector<PredictedRow> on_8, on_16;
  for (const PredictedRow& row : rows) {
    (row.processors == 8 ? on_8 : on_16).push_back(row);
  }
  EXPECT_EQ(ConfigurationText(BestOf(on_8)), "B2PC5 4x2");
  EXPECT_EQ(ConfigurationText(BestOf(on_16)), "B4PC5 4x4");
  EXPECT_GT(BestOf(on_16).S_T.value, BestOf(on_8).S_T.value);
}

TEST(CrayMachine, HoldsThePapersRule) {
  for (const int processors : {4, 8, 16}) {
    const auto rows = CrayRows({processors});
    EXPECT_EQ(&RuleOf(rows), &BestOf(rows)) << processors;
  }
}

TEST(UsefulPartitions, AreThePapers) {
  const auto texts = [](int processors, int block) {
    std::string text;
    for (const auto& partition : UsefulPartitions(processors, 4, block)) {
      text += std::to_string(partition.chain_tasks) + "x" +
              std::to_string(partition.integration_tasks) + " ";
    }
    return text;
  };
  EXPECT_EQ(texts(1, 4), "1x1 ");
  EXPECT_EQ(texts(4, 4), "1x4 2x2 4x1 ");
  EXPECT_EQ(texts(8, 4), "2x4 4x2 ");
  EXPECT_EQ(texts(8, 2), "4x2 ");
  EXPECT_EQ(texts(8, 1), "4x1 ");
  EXPECT_EQ(texts(3, 2), "1x2 2x1 ");
  EXPECT_EQ(texts(64, 4), "4x4 ");
}

TEST(Predictor, GivesTheSameDoublesForTheSameSeed) {
  MachineModel machine = Cray();
  machine.lanes[1][static_cast<std::size_t>(Block::kOcd)].spread = {0.9, 1,
                                                                    1.2};
  const auto times = [&](std::uint64_t seed) {
    Predictor predictor(machine, {.replications = 5, .seed = seed});
    return predictor.Predict(CaseOf(OneLane({4}), Sweeps()[0], {2, 2}, 4))
        .seconds;
  };
  EXPECT_EQ(times(1), times(1));
  EXPECT_NE(times(1), times(2));
}

TEST(Predictor, SharesReplicationsAsConditionsShareTime) {
  MachineModel machine = Cray();
  machine.conditions.push_back(machine.conditions[0]);
  machine.conditions[0].name = "near";
  machine.conditions[0].share = 0.75;
  machine.conditions[1].name = "far";
  machine.conditions[1].share = 0.25;
  machine.conditions[1].waits.at(macrotask::WaitKind::kHold).barrier.two = 1;
  Predictor predictor(machine, {.replications = 8});
  const Prediction prediction =
      predictor.Predict(CaseOf(OneLane({2}), Sweeps()[2], {2, 1}, 2));
  int slow = 0;
  for (const double seconds : prediction.seconds) slow += seconds > 10;
  EXPECT_EQ(slow, 2);
}

TEST(Predictor, IsBoundedByItsLimits) {
  for (const PredictedRow& row : CrayRows({1, 2, 4, 8, 16})) {
    EXPECT_LE(row.S_p.value, row.free_sync * (1 + 1e-9));
    EXPECT_LE(row.free_sync, row.critical_path * (1 + 1e-9));
    EXPECT_LE(row.free_sync, row.work_bound * (1 + 1e-9));
    EXPECT_NEAR(row.where.total(), 1, 1e-9);
  }
}

TEST(Predictor, SaysWhichCostsTheMachineLacks) {
  Predictor predictor(Cray(), {});
  RunCase run_case = CaseOf(OneLane({4}), Sweeps()[0], {2, 2}, 4);
  run_case.wait = macrotask::WaitKind::kSpin;
  EXPECT_THROW(predictor.Predict(run_case), std::invalid_argument);
  run_case.wait = macrotask::WaitKind::kHold;
  run_case.num_lanes = 4;
  EXPECT_THROW(predictor.Predict(run_case), std::invalid_argument);
}

TEST(PredictRows, NeedB1PC5ToCompareWith) {
  Predictor predictor(Cray(), {.replications = 1});
  EXPECT_THROW(PredictRows(OneLane({4}), {Sweeps()[0]}, &predictor),
               std::invalid_argument);
}

// Where waiting costs much, one task for all points of B1PC5 loses.
TEST(FindTurn, FindsTheWorkFromWhichTheRuleHolds) {
  MachineModel machine = Cray();
  machine.slowdowns.clear();
  Predictor as_it_is(machine, {.replications = 1});
  const RuleTurn holds = FindTurn(OneLane({4}), Sweeps(), &as_it_is);
  ASSERT_TRUE(holds.work.has_value());
  EXPECT_EQ(*holds.work, 0);
  EXPECT_EQ(holds.rule, holds.best);

  for (BlockCost& cost : machine.lanes[1]) {
    cost = {cost.call / 30, cost.pack / 30, cost.item / 30};
  }
  Predictor faster(machine, {.replications = 1});
  const RuleTurn turns = FindTurn(OneLane({4}), Sweeps(), &faster);
  EXPECT_NE(turns.rule, turns.best);
  EXPECT_GT(turns.loss, 1);
  ASSERT_TRUE(turns.work.has_value());
  EXPECT_GT(*turns.work, 0);
  // With so much work it holds, with half of it not.
  TableOptions options = OneLane({4});
  options.work = *turns.work;
  auto rows = PredictRows(options, Sweeps(), &faster);
  EXPECT_EQ(&RuleOf(rows), &BestOf(rows));
  options.work = *turns.work / 2;
  rows = PredictRows(options, Sweeps(), &faster);
  EXPECT_NE(&RuleOf(rows), &BestOf(rows));
}

TEST(ValidationCases, ShareNoMethodWithTheCalibration) {
  int serial = 0;
  for (const RunCase& run_case : ValidationCases()) {
    const std::string method = run_case.figure.method.name();
    EXPECT_TRUE(method == "B1PC5" || method == "B2PC5" || method == "B4PC5");
    serial += run_case.figure.partition.num_tasks() == 1;
  }
  EXPECT_GT(serial, 0);
}

}  // namespace
}  // namespace bench::predict
