#include "bench/breakdown.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <set>
#include <stdexcept>
#include <utility>

#include "macrotask/trace.h"
#include "macrotask/trace_text.h"

namespace bench {
namespace {

using macrotask::TraceObject;
using macrotask::TraceRecord;
using enum macrotask::TraceAction;

constexpr int kBegin = macrotask::kFirstUserAction;
constexpr int kEnd = kBegin + 1;

bool Is(const TraceRecord& record, int user_action) {
  return static_cast<int>(record.action) == user_action;
}

// One wait, from its beginning to its end; none at a barrier of one task.
struct Wait {
  TraceObject object;
  std::size_t turn;  // how many the task had at the object before
  std::uint64_t begin;
  std::uint64_t end;
};

std::vector<Wait> WaitsOf(const std::vector<TraceRecord>& records) {
  std::vector<Wait> waits;
  std::map<TraceObject, std::size_t> turns;
  for (std::size_t i = 1; i < records.size(); ++i) {
    const TraceRecord& from = records[i - 1];
    const TraceRecord& to = records[i];
    const bool is_wait =
        EndOf(from.action) != kNone && to.action == EndOf(from.action);
    const bool alone = from.action == kBarrierSync && from.detail() == 1;
    if (!is_wait || alone) continue;
    const TraceObject object = ObjectOf(from);
    waits.push_back({object, turns[object]++, from.clock, to.clock});
  }
  return waits;
}

// When waits could end: at a barrier when the last task of the turn arrived, at
// an event when it was posted.
class Releases {
 public:
  explicit Releases(const RunRecords& run) {
    for (const auto& records : run) {
      for (const Wait& wait : WaitsOf(records)) {
        if (wait.object.kind == macrotask::ObjectKind::kBarrier) Arrive(wait);
      }
      for (const TraceRecord& record : records) {
        if (record.action != kEventPost) continue;
        clocks_[ObjectOf(record)].push_back(record.clock);
      }
    }
  }

  // Within the wait.
  std::uint64_t Of(const Wait& wait) const {
    const auto clocks = clocks_.find(wait.object);
    if (clocks == clocks_.end() || wait.turn >= clocks->second.size()) {
      return wait.end;
    }
    return std::clamp(clocks->second[wait.turn], wait.begin, wait.end);
  }

 private:
  void Arrive(const Wait& wait) {
    auto& clocks = clocks_[wait.object];
    if (clocks.size() <= wait.turn) clocks.resize(wait.turn + 1, 0);
    clocks[wait.turn] = std::max(clocks[wait.turn], wait.begin);
  }

  std::map<TraceObject, std::vector<std::uint64_t>> clocks_;  // by turn
};

// Which of the constructs the objects are at which one task waits.
class Naming {
 public:
  explicit Naming(const std::vector<Construct>& constructs)
      : constructs_(constructs) {}

  std::size_t Of(const TraceObject& object) {
    if (object.kind == macrotask::ObjectKind::kEvent) {
      return static_cast<std::size_t>(Construct::kEvent);
    }
    const auto [known, is_new] = barriers_.try_emplace(object.number,  //
                                                       barriers_.size());
    return static_cast<std::size_t>(constructs_.at(known->second));
  }

 private:
  const std::vector<Construct>& constructs_;
  // number: which one of the task's, in the order in which it came to them
  std::map<std::uint32_t, std::size_t> barriers_;
};

// A piece of time.
struct Span {
  std::uint64_t begin;
  std::uint64_t end;

  // Ticks of [from, to] that are in it.
  std::uint64_t Share(std::uint64_t from, std::uint64_t to) const {
    return std::clamp(to, begin, end) - std::clamp(from, begin, end);
  }
};

Span SpanOf(const std::vector<TraceRecord>& records) {
  return {records.front().clock, records.back().clock};
}

TaskBreakdown BreakDownTask(const std::vector<TraceRecord>& records,
                            const Span& run, const Releases& releases,
                            Naming naming) {
  TaskBreakdown task;
  const Span own = SpanOf(records);
  task.compute = run.Share(own.begin, own.end);
  for (const Wait& wait : WaitsOf(records)) {
    const std::uint64_t release = releases.Of(wait);
    Waiting& waiting = task.waiting[naming.Of(wait.object)];
    waiting.imbalance += run.Share(wait.begin, release);
    waiting.sync += run.Share(release, wait.end);
    task.compute -= run.Share(wait.begin, wait.end);
  }
  // It was let go, as the first task was, but is not there yet.
  constexpr auto kAllTasks = static_cast<std::size_t>(Construct::kAllTasks);
  task.waiting[kAllTasks].sync += run.Share(run.begin, own.begin);
  return task;
}

}  // namespace

const char* Name(Construct construct) {
  constexpr const char* kNames[kNumConstructs] = {"BARSYNC(all)", "BARSYNC(m^)",
                                                  "BARSYNC(p^)", "EVWAIT"};
  return kNames[static_cast<int>(construct)];
}

std::vector<Construct> ConstructsOf(integrators::Figure figure,
                                    integrators::Partition partition) {
  using integrators::Figure;
  std::vector<Construct> constructs;
  if (partition.num_tasks() > 1) constructs.push_back(Construct::kAllTasks);
  if (partition.chain_tasks > 1) constructs.push_back(Construct::kChains);
  if (partition.integration_tasks > 1) constructs.push_back(Construct::kPoints);
  const bool event = figure == Figure::kFigure2
                         ? partition.chain_tasks > 1
                         : partition.integration_tasks > 1;
  if (event) constructs.push_back(Construct::kEvent);
  return constructs;
}

std::uint64_t TaskBreakdown::total() const {
  std::uint64_t ticks = compute;
  for (const Waiting& own : waiting) ticks += own.imbalance + own.sync;
  return ticks;
}

void RecordBegin(int task) {
  macrotask::RecordUser(kBegin, static_cast<std::uint64_t>(task));
}
void RecordEnd(int task) {
  macrotask::RecordUser(kEnd, static_cast<std::uint64_t>(task));
}

RunRecords RecordsOfLastRun(const macrotask::Trace& trace, int num_tasks) {
  // By number: the tasks of older runs may have had the same.
  std::map<std::uint32_t, std::vector<TraceRecord>> records;
  std::map<std::uint64_t, std::uint32_t> numbers;  // by task of the run
  std::set<std::uint32_t> running;
  for (const TraceRecord& record : InOrderOfTime(trace)) {
    if (Is(record, kBegin)) {
      numbers[record.data] = record.task;
      running.insert(record.task);
      records[record.task].clear();
    }
    if (!running.contains(record.task)) continue;
    records[record.task].push_back(record);
    if (Is(record, kEnd)) running.erase(record.task);
  }
  RunRecords run;
  for (int task = 0; task < num_tasks; ++task) {
    const auto number = numbers.find(static_cast<std::uint64_t>(task));
    if (number == numbers.end() || running.contains(number->second)) {
      throw std::runtime_error(fmt::format(
          "the history trace does not have all of task {}", task + 1));
    }
    run.push_back(std::move(records[number->second]));
  }
  return run;
}

std::vector<TaskBreakdown> BreakDown(const RunRecords& run,
                                     const std::vector<Construct>& constructs) {
  const Releases releases(run);
  const Span time = SpanOf(run.front());
  std::vector<TaskBreakdown> tasks;
  for (const auto& records : run) {
    tasks.push_back(BreakDownTask(records, time, releases, Naming(constructs)));
  }
  return tasks;
}

}  // namespace bench
