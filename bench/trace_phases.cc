#include "bench/trace_phases.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <set>

namespace bench {
namespace {

using macrotask::TraceRecord;
using enum macrotask::TraceAction;

constexpr std::uint64_t kNever = std::numeric_limits<std::uint64_t>::max();

struct Arrival {
  std::uint32_t task;
  std::uint64_t clock;
  std::uint64_t leave = kNever;
};

// A barrier while it has one number of tasks.
struct Use {
  std::uint32_t barrier = 0;
  std::uint32_t num_tasks = 0;  // 0: nobody has arrived yet
  bool from_start = false;      // its first arrival is the first of a phase
  std::vector<Arrival> arrivals;
  std::map<std::uint32_t, std::size_t> inside;  // task: its arrival
};

class UseFinder {
 public:
  explicit UseFinder(const TraceHistory& history) : history_(history) {}

  void Add(const TraceRecord& record) {
    Use& use = Current(record.object());
    if (record.action == kBarrierAssign) {
      Begin(record.object(), record.clock >= history_.complete_from);
    } else if (record.action == kBarrierSync) {
      Arrive(record, &use);
    } else if (record.action == kBarrierSyncEnd) {
      Leave(record, &use);
    }
  }

  const std::map<std::uint32_t, std::vector<Use>>& uses() const {
    return uses_;
  }

 private:
  Use& Begin(std::uint32_t barrier, bool from_start) {
    Use use;
    use.barrier = barrier;
    use.from_start = from_start;
    uses_[barrier].push_back(std::move(use));
    return uses_[barrier].back();
  }

  Use& Current(std::uint32_t barrier) {
    const auto& own = uses_[barrier];
    return own.empty() ? Begin(barrier, history_.num_lost == 0)
                       : uses_[barrier].back();
  }

  void Arrive(const TraceRecord& record, Use* use) {
    if (use->num_tasks != 0 && use->num_tasks != record.detail()) {
      use = &Begin(record.object(), false);  // its BARASGN is not there
    }
    use->num_tasks = record.detail();
    use->inside[record.task] = use->arrivals.size();
    use->arrivals.push_back({record.task, record.clock});
  }

  void Leave(const TraceRecord& record, Use* use) {
    const auto arrival = use->inside.find(record.task);
    if (arrival == use->inside.end()) {
      use->from_start = false;
    } else {
      use->arrivals[arrival->second].leave = record.clock;
      use->inside.erase(arrival);
    }
  }

  const TraceHistory& history_;
  std::map<std::uint32_t, std::vector<Use>> uses_;
};

using Position = std::vector<Arrival>::const_iterator;

// Arrivals [begin, end), at least one, can be of one phase, or part of one.
bool FitOnePhase(Position begin, Position end) {
  std::set<std::uint32_t> tasks;
  const std::uint64_t last = std::prev(end)->clock;
  return std::all_of(begin, end, [&](const Arrival& arrival) {
    return tasks.insert(arrival.task).second && arrival.leave >= last;
  });
}

bool NobodyHasLeft(Position begin, Position end) {
  return std::all_of(begin, end, [](const Arrival& arrival) {
    return arrival.leave == kNever;
  });
}

// How many phases cannot be, if the first `skip` arrivals are the rest of one.
std::size_t CountMisfits(const std::vector<Arrival>& arrivals,
                         std::size_t num_tasks, std::size_t skip) {
  std::size_t misfits = 0;
  std::size_t begin = 0;
  for (std::size_t end = skip; begin < arrivals.size();
       begin = end, end += num_tasks) {
    if (begin == end) continue;  // nothing to skip
    const auto first = arrivals.begin() + static_cast<std::ptrdiff_t>(begin);
    const bool over = end <= arrivals.size();
    const auto last = over ? arrivals.begin() + static_cast<std::ptrdiff_t>(end)
                           : arrivals.end();
    misfits +=
        !FitOnePhase(first, last) || (!over && !NobodyHasLeft(first, last));
  }
  return misfits;
}

// How many arrivals come before the first of a phase; all if that is not clear.
std::size_t CountSkipped(const std::vector<Arrival>& arrivals,
                         std::size_t num_tasks) {
  std::size_t best = 0, fewest = arrivals.size() + 1;
  bool clear = true;
  for (std::size_t skip = 0; skip < std::min(num_tasks, arrivals.size() + 1);
       ++skip) {
    const std::size_t misfits = CountMisfits(arrivals, num_tasks, skip);
    if (misfits > fewest) continue;
    clear = misfits < fewest;
    fewest = misfits;
    best = skip;
  }
  return clear ? best : arrivals.size();
}

void AddPhases(const Use& use, std::uint64_t complete_from,
               BarrierPhases* phases) {
  if (use.num_tasks == 0) return;
  std::vector<Arrival> arrivals = use.arrivals;
  std::size_t begin = 0;
  if (!use.from_start) {
    const std::size_t before = std::erase_if(
        arrivals, [&](const Arrival& a) { return a.clock < complete_from; });
    begin = CountSkipped(arrivals, use.num_tasks);
    if (before + begin > 0) phases->skipped[use.barrier] += before + begin;
  }
  for (; begin + use.num_tasks <= arrivals.size(); begin += use.num_tasks) {
    const std::size_t last = begin + use.num_tasks - 1;
    const std::size_t before = use.num_tasks == 1 ? last : last - 1;
    phases->complete.push_back({use.barrier, arrivals[last].task,
                                arrivals[last].clock, arrivals[before].clock,
                                use.num_tasks});
  }
}

}  // namespace

BarrierPhases FindPhases(const TraceHistory& history) {
  UseFinder finder(history);
  for (const TraceRecord& record : history.records) {
    if (ObjectOf(record).kind == macrotask::ObjectKind::kBarrier)
      finder.Add(record);
  }
  BarrierPhases phases;
  for (const auto& [barrier, uses] : finder.uses()) {
    for (const Use& use : uses) {
      AddPhases(use, history.complete_from, &phases);
    }
  }
  return phases;
}

}  // namespace bench
