#include "bench/sync_rows.h"

namespace bench {
namespace {

std::optional<Summary> SummaryOf(const std::vector<SyncSample>& samples,
                                 std::optional<double> SyncSample::*value) {
  std::vector<double> values;
  for (const SyncSample& sample : samples) {
    if (sample.*value) values.push_back(*(sample.*value));
  }
  if (values.empty()) return std::nullopt;
  return Summarize(values);
}

double MedianOf(const std::vector<SyncSample>& samples,
                double SyncSample::*value) {
  std::vector<double> values;
  for (const SyncSample& sample : samples) values.push_back(sample.*value);
  return Median(values);
}

void AddFigures(const std::vector<SyncSample>& samples, SyncRow* row) {
  if (samples.empty()) return;
  row->total = MedianOf(samples, &SyncSample::seconds);
  row->cpu = MedianOf(samples, &SyncSample::cpu);
  row->overhead = Summarize(Overheads(samples, row->variant.parts));
  row->first = SummaryOf(samples, &SyncSample::first);
  row->last = SummaryOf(samples, &SyncSample::last);
  row->fairness = SummaryOf(samples, &SyncSample::fairness);
}

SyncRow MakeRow(const SyncSeries& series, const DistanceSplit& split,
                Distance distance) {
  SyncRow row = {.variant = series.variant,
                 .distance = distance,
                 .calls = series.calls,
                 .dropped = {},
                 .overhead = {},
                 .first = {},
                 .last = {},
                 .fairness = {}};
  std::vector<SyncSample> kept;
  for (const SyncSample& sample : series.samples) {
    if (split.Of(sample.conditions.before.round_trip) != distance) continue;
    const Disturbance disturbance = JudgeSample(sample.conditions, split);
    row.dropped.Add(disturbance);
    if (disturbance == Disturbance::kNone) kept.push_back(sample);
  }
  AddFigures(kept, &row);
  return row;
}

}  // namespace

std::vector<double> Overheads(const std::vector<SyncSample>& samples,
                              int parts) {
  std::vector<double> overheads;
  for (const SyncSample& sample : samples) {
    overheads.push_back((sample.seconds - sample.reference) / parts);
  }
  return overheads;
}

DistanceSplit SplitOf(const std::vector<SyncSeries>& series) {
  std::vector<double> round_trips;
  for (const SyncSeries& one : series) {
    for (const SyncSample& sample : one.samples) {
      round_trips.push_back(sample.conditions.after.round_trip);
    }
  }
  return SplitDistances(round_trips);
}

std::vector<SyncRow> MakeRows(const std::vector<SyncSeries>& series,
                              const DistanceSplit& split) {
  std::vector<SyncRow> rows;
  for (const SyncSeries& one : series) {
    if (!split.has_two() || one.samples.empty()) {
      rows.push_back(MakeRow(one, split, Distance::kOnly));
      continue;
    }
    for (const Distance distance : {Distance::kNear, Distance::kFar}) {
      SyncRow row = MakeRow(one, split, distance);
      if (row.overhead || row.dropped.total() > 0) {
        rows.push_back(std::move(row));
      }
    }
  }
  return rows;
}

}  // namespace bench
