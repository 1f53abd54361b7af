#include "bench/sync_latency.h"

#include <algorithm>
#include <limits>

namespace bench {
namespace {

struct Acquisition {
  std::size_t task;
  std::uint64_t asked, got, released;
};

Latencies BarrierLatencies(const std::vector<TaskMarks>& tasks) {
  std::size_t num_calls = std::numeric_limits<std::size_t>::max();
  for (const TaskMarks& task : tasks) {
    num_calls = std::min({num_calls, task.in.size(), task.out.size()});
  }
  Latencies latencies;
  for (std::size_t call = 0; call < num_calls; ++call) {
    std::uint64_t last_in = 0, last_out = 0;
    for (const TaskMarks& task : tasks) {
      last_in = std::max(last_in, task.in[call]);
      last_out = std::max(last_out, task.out[call]);
    }
    latencies.last.push_back(SecondsBetween(last_in, last_out));
  }
  return latencies;
}

Latencies FromFirstTask(const std::vector<TaskMarks>& tasks) {
  std::size_t num_calls = tasks[0].in.size();
  for (std::size_t t = 1; t < tasks.size(); ++t) {
    num_calls = std::min(num_calls, tasks[t].out.size());
  }
  Latencies latencies;
  for (std::size_t call = 0; call < num_calls; ++call) {
    double first = std::numeric_limits<double>::infinity();
    double last = -first;
    for (std::size_t t = 1; t < tasks.size(); ++t) {
      const double seconds =
          SecondsBetween(tasks[0].in[call], tasks[t].out[call]);
      first = std::min(first, seconds);
      last = std::max(last, seconds);
    }
    if (tasks.size() > 2) latencies.first.push_back(first);
    latencies.last.push_back(last);
  }
  return latencies;
}

}  // namespace

Latencies CalcLatencies(LatencyKind kind, const std::vector<TaskMarks>& tasks) {
  switch (kind) {
    case LatencyKind::kNone:
      return {};
    case LatencyKind::kLastInLastOut:
      return BarrierLatencies(tasks);
    case LatencyKind::kFromFirstTask:
      return tasks.size() > 1 ? FromFirstTask(tasks) : Latencies();
    case LatencyKind::kHandOff:
      return {{}, CalcHandOffs(tasks)};
  }
  return {};
}

std::vector<double> CalcHandOffs(const std::vector<TaskMarks>& tasks) {
  std::vector<Acquisition> acquisitions;
  for (std::size_t t = 0; t < tasks.size(); ++t) {
    const std::size_t num_calls = tasks[t].release.size();
    for (std::size_t call = 0; call < num_calls; ++call) {
      acquisitions.push_back(
          {t, tasks[t].in[call], tasks[t].out[call], tasks[t].release[call]});
    }
  }
  std::sort(
      acquisitions.begin(), acquisitions.end(),
      [](const Acquisition& a, const Acquisition& b) { return a.got < b.got; });
  std::vector<double> seconds;
  for (std::size_t i = 1; i < acquisitions.size(); ++i) {
    const Acquisition& before = acquisitions[i - 1];
    const Acquisition& next = acquisitions[i];
    if (next.task == before.task || next.asked >= before.released) continue;
    seconds.push_back(SecondsBetween(before.released, next.got));
  }
  return seconds;
}

std::vector<double> CalcWholes(const std::vector<TaskMarks>& tasks) {
  const TaskMarks& first = tasks[0];
  std::vector<double> seconds;
  for (std::size_t call = 0; call < first.release.size(); ++call) {
    seconds.push_back(SecondsBetween(first.in[call], first.release[call]));
  }
  return seconds;
}

}  // namespace bench
