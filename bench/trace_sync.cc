#include "bench/trace_sync.h"

#include <algorithm>
#include <map>
#include <set>

namespace bench {
namespace {

using macrotask::TraceRecord;
using enum macrotask::TraceAction;

// Follows one lock.
class HoldFinder {
 public:
  HoldFinder(std::uint32_t lock, std::vector<LockHold>* holds)
      : lock_(lock), holds_(holds) {}

  void Add(const TraceRecord& record) {
    Advance(record.clock);
    switch (record.action) {
      case kLockOn:
        waiting_.insert(record.task);
        break;
      case kLockOnEnd:
      case kLockTestOn:
        waiting_.erase(record.task);
        holders_.push_back({lock_, record.task, record.clock, 0, 0});
        break;
      case kLockOff:
        LetGo(record);
        break;
      case kLockAssign:
        waiting_.clear();
        holders_.clear();
        break;
      default:
        break;
    }
  }

  void Finish(std::uint64_t clock) {
    Advance(clock);
    for (LockHold& hold : holders_) {
      hold.end = clock;
      holds_->push_back(hold);
    }
  }

 private:
  void Advance(std::uint64_t clock) {
    if (!waiting_.empty()) {
      for (LockHold& hold : holders_) hold.contended += clock - clock_;
    }
    clock_ = clock;
  }

  // There is more than one holder where the next one's record is older than
  // the LOCKOFF. Any task may unlock: if it is no holder, the oldest one's hold
  // ends.
  void LetGo(const TraceRecord& record) {
    if (holders_.empty()) return;
    auto hold = std::find_if(
        holders_.begin(), holders_.end(),
        [&](const LockHold& own) { return own.task == record.task; });
    if (hold == holders_.end()) hold = holders_.begin();
    hold->end = record.clock;
    holds_->push_back(*hold);
    holders_.erase(hold);
  }

  std::uint32_t lock_;
  std::vector<LockHold>* holds_;
  std::vector<LockHold> holders_;  // oldest first
  std::set<std::uint32_t> waiting_;
  std::uint64_t clock_ = 0;
};

}  // namespace

std::vector<EventWake> FindWakes(const TraceHistory& history) {
  std::map<std::uint32_t, std::vector<TraceRecord>> posts;  // by event
  for (const TraceRecord& record : history.records) {
    if (record.action == kEventPost) posts[record.object()].push_back(record);
  }
  std::vector<EventWake> wakes;
  for (const TraceWait& wait : history.waits) {
    if (wait.action != kEventWait || !wait.finished) continue;
    const auto& own = posts[wait.object.number];
    const auto post = std::lower_bound(
        own.begin(), own.end(), wait.begin,
        [](const TraceRecord& r, std::uint64_t t) { return r.clock < t; });
    if (post != own.end() && post->clock <= wait.end) {
      wakes.push_back({wait, *post});
    }
  }
  return wakes;
}

std::vector<LockHold> FindHolds(const TraceHistory& history) {
  std::vector<LockHold> holds;
  std::map<std::uint32_t, HoldFinder> finders;
  for (const TraceRecord& record : history.records) {
    const macrotask::TraceObject object = ObjectOf(record);
    if (object.kind != macrotask::ObjectKind::kLock) continue;
    finders.try_emplace(object.number, object.number, &holds)
        .first->second.Add(record);
  }
  for (auto& [lock, finder] : finders) finder.Finish(history.end);
  return holds;
}

}  // namespace bench
