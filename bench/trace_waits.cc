#include "bench/trace_waits.h"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <map>

namespace bench {
namespace {

using macrotask::TraceAction;
using macrotask::TraceRecord;

TraceAction EndOfWait(TraceAction action) {
  return action == TraceAction::kSleep ? TraceAction::kWake
                                       : macrotask::EndOf(action);
}

class Pairer {
 public:
  void Add(const TraceRecord& record) {
    Line& line = lines_[record.task];
    if (record.action == TraceAction::kTaskBegin ||
        record.action == TraceAction::kTaskEnd) {
      line.open.clear();
      line.ended = record.action == TraceAction::kTaskEnd;
      return;
    }
    // Who does something else does not sleep any more.
    if (!line.open.empty() && record.action != TraceAction::kWake &&
        waits_[line.open.back()].action == TraceAction::kSleep) {
      line.open.pop_back();
    }
    if (EndOfWait(record.action) == TraceAction::kNone) {
      End(record, &line.open);
    } else if (!line.ended) {
      Begin(record, &line.open);
    }
  }

  std::vector<TraceWait> Waits(std::uint64_t end) {
    for (const auto& [task, line] : lines_) {
      for (const std::size_t i : line.open) {
        waits_[i].end = end;
        known_[i] = true;
      }
    }
    std::vector<TraceWait> waits;
    for (std::size_t i = 0; i < waits_.size(); ++i) {
      if (known_[i]) waits.push_back(waits_[i]);
    }
    return waits;
  }

 private:
  using Stack = std::vector<std::size_t>;  // indices into waits_

  struct Line {
    Stack open;          // the innermost last
    bool ended = false;  // its body; the pthread may still sleep
  };

  // The open wait for the same, for which `of` its action is `action`.
  template <typename Of>
  Stack::iterator Find(Stack* open, const TraceRecord& record,
                       const Of& of) const {
    const macrotask::TraceObject object = ObjectOf(record);
    return std::find_if(open->begin(), open->end(), [&](std::size_t i) {
      return of(waits_[i].action) == record.action &&
             waits_[i].object == object;
    });
  }

  void Begin(const TraceRecord& record, Stack* open) {
    open->erase(Find(open, record, std::identity()), open->end());
    open->push_back(waits_.size());
    waits_.push_back({record.action, ObjectOf(record), record.task,
                      record.clock, 0, false, 0});
    known_.push_back(false);
  }

  void End(const TraceRecord& record, Stack* open) {
    const auto wait = Find(open, record, EndOfWait);
    if (wait == open->end()) return;
    waits_[*wait].end = record.clock;
    waits_[*wait].finished = true;
    known_[*wait] = true;
    open->erase(wait, open->end());
  }

  std::vector<TraceWait> waits_;
  std::vector<bool> known_;              // that it has an end
  std::map<std::uint32_t, Line> lines_;  // by task
};

void SetDepths(std::vector<TraceWait>* waits) {
  std::map<std::uint32_t, std::vector<std::uint64_t>> ends;  // of those around
  for (TraceWait& wait : *waits) {
    auto& around = ends[wait.task];
    while (!around.empty() && around.back() <= wait.begin) around.pop_back();
    wait.depth = static_cast<int>(around.size());
    around.push_back(wait.end);
  }
}

}  // namespace

std::vector<TraceWait> PairWaits(const std::vector<TraceRecord>& records,
                                 std::uint64_t end) {
  Pairer pairer;
  for (const TraceRecord& record : records) pairer.Add(record);
  std::vector<TraceWait> waits = pairer.Waits(end);
  SetDepths(&waits);
  return waits;
}

}  // namespace bench
