#include "bench/sync_report.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

namespace bench {
namespace {

SyncRow HandMadeRow() {
  SyncRow row;
  row.variant.construct = "BARSYNC";
  row.variant.by = "hold";
  row.variant.num_tasks = 2;
  row.variant.work = 0.1;
  row.distance = Distance::kNear;
  row.calls = 4096;
  row.dropped = {.distance = 1, .stolen = 2, .switched = 0};
  row.total = 141e-9;
  row.cpu = 282e-9;
  row.overhead = Summarize({40e-9, 41e-9, 42e-9});
  row.last = Summarize({80e-9});
  return row;
}

SyncResult HandMadeResult() {
  SyncRow missing;
  missing.variant.construct = "barrier";
  missing.variant.by = "libomp";
  missing.variant.num_tasks = 2;
  missing.variant.missing = "not installed";
  SyncResult result;
  result.machine = DescribeMachine();
  result.repetitions = 3;
  result.split = {100e-9};
  result.round_trips = {70e-9, 200e-9};
  result.rows = {HandMadeRow(), missing};
  return result;
}

bool Has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(DurationText, HasTheUnitThatSuits) {
  EXPECT_EQ(DurationText(41.2e-9), "41.2 ns");
  EXPECT_EQ(DurationText(1.5e-6), "1.5 us");
  EXPECT_EQ(DurationText(2.34567e-3), "2.35 ms");
}

TEST(SyncText, HasARowWithIntervalDistanceAndDroppedSamples) {
  const std::string text = SyncText(HandMadeResult());
  EXPECT_TRUE(Has(text, "41.0 [40.0, 42.0]")) << text;
  EXPECT_TRUE(Has(text, "| near ")) << text;
  EXPECT_TRUE(Has(text, "Of 6 samples 3 were dropped")) << text;
}

TEST(SyncText, SaysWhatIsNotInstalled) {
  EXPECT_TRUE(Has(SyncText(HandMadeResult()), "| not installed "));
}

TEST(SyncCsv, HasAsManyCellsInEveryRow) {
  const std::string csv = SyncCsv(HandMadeResult());
  std::vector<long> commas;
  for (std::size_t i = 0; i < csv.size(); i = csv.find('\n', i) + 1) {
    const auto begin = csv.begin() + static_cast<std::ptrdiff_t>(i);
    commas.push_back(std::count(begin, std::find(begin, csv.end(), '\n'), ','));
  }
  ASSERT_EQ(commas.size(), 3u);
  EXPECT_EQ(commas[1], commas[0]);
  EXPECT_EQ(commas[2], commas[0]);
}

TEST(SyncJson, HasTheLayoutOfGoogleBenchmark) {
  const auto json = nlohmann::json::parse(SyncJson(HandMadeResult()));
  EXPECT_TRUE(json["context"]["num_cpus"].is_number_integer());
  ASSERT_EQ(json["benchmarks"].size(), 2u);
  const auto& row = json["benchmarks"][0];
  EXPECT_EQ(row["name"], "BARSYNC/hold/tasks:2/work_us:0.1/skew:zero/near");
  EXPECT_EQ(row["time_unit"], "ns");
  EXPECT_EQ(row["iterations"], 4096);
  EXPECT_DOUBLE_EQ(row["real_time"], 141);
  EXPECT_DOUBLE_EQ(row["cpu_time"], 282);
  EXPECT_DOUBLE_EQ(row["overhead"]["median"], 41);
  EXPECT_EQ(row["dropped"]["stolen"], 2);
  EXPECT_EQ(json["benchmarks"][1]["error_message"], "not installed");
}

TEST(BreakEvenText, SaysTheWorkAndTheRangeThatWasTried) {
  SyncResult result = HandMadeResult();
  BreakEvenRow row;
  row.construct = "BARSYNC";
  row.by = "hold";
  row.distance = Distance::kNear;
  row.half = {.median = 44e-9, .low = 40e-9, .high = 50e-9};
  row.ninety = {.median = {}, .low = 2e-6, .high = {}};
  row.n = 9;
  result.break_even = BreakEven{.split = DistanceSplit{100e-9},
                                .least_work = 1e-8,
                                .most_work = 1e-3,
                                .round_trips = {},
                                .rows = {row}};
  const std::string text = SyncText(result);
  EXPECT_TRUE(Has(text, "| 44 ns [40 ns, 50 ns] ")) << text;
  EXPECT_TRUE(Has(text, "| > 1 ms [2 us, > 1 ms] ")) << text;
  EXPECT_TRUE(Has(text, "more than 44 ns\nof work")) << text;
}

}  // namespace
}  // namespace bench
