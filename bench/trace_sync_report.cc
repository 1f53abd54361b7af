#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

#include "bench/text_table.h"
#include "bench/trace_phases.h"
#include "bench/trace_reports.h"
#include "bench/trace_sync.h"

namespace bench {
namespace {

using macrotask::TraceRecord;

// An object and one of the tasks that use it.
using ObjectAndTask = std::pair<std::uint32_t, std::uint32_t>;

std::string ObjectsTable(const TraceHistory& history,
                         const TraceFilter& filter) {
  struct Totals {
    std::uint64_t calls = 0, waits = 0, waited = 0, longest = 0;
    std::uint32_t longest_task = 0;
  };
  std::map<macrotask::TraceObject, Totals> totals;
  for (const TraceRecord& record : history.records) {
    const macrotask::TraceObject object = ObjectOf(record);
    const std::uint64_t calls = CallsOf(record);
    if (object.kind == macrotask::ObjectKind::kNone || calls == 0) continue;
    if (filter.Record(record)) totals[object].calls += calls;
  }
  for (const TraceWait& wait : history.waits) {
    if (wait.object.kind == macrotask::ObjectKind::kNone) continue;
    if (!filter.Task(wait.task) || !filter.Action(wait.action)) continue;
    Totals& object = totals[wait.object];
    const std::uint64_t ticks = wait.end - wait.begin;
    if (object.waits++ == 0 || ticks > object.longest) {
      object.longest = ticks;
      object.longest_task = wait.task;
    }
    object.waited += ticks;
  }
  TextTable table({"object", "calls", "waits", "waited (us)", "mean (us)",
                   "longest (us)", "by task"});
  for (const auto& [object, own] : totals) {
    const bool waits = own.waits > 0;
    const double waited = history.UsOf(own.waited);
    table.AddRow({ObjectText(object), std::to_string(own.calls),
                  std::to_string(own.waits), waits ? UsText(waited) : "",
                  waits ? UsText(waited / static_cast<double>(own.waits)) : "",
                  waits ? UsText(history.UsOf(own.longest)) : "",
                  waits ? std::to_string(own.longest_task) : ""});
  }
  return table.Markdown();
}

std::string SkippedText(const BarrierPhases& phases) {
  std::string text;
  for (const auto& [barrier, arrivals] : phases.skipped) {
    text += fmt::format(
        "\nbarrier {}: {} arrival{} skipped, of phases that are not all in the "
        "trace.\n",
        barrier, arrivals, arrivals == 1 ? "" : "s");
  }
  return text;
}

std::string BarriersText(const TraceHistory& history,
                         const TraceFilter& filter) {
  struct Late {
    std::uint64_t phases = 0, held_up = 0, longest = 0;
  };
  const BarrierPhases phases = FindPhases(history);
  std::map<std::uint32_t, std::uint64_t> num_phases;
  std::map<ObjectAndTask, Late> late;
  for (const BarrierPhase& phase : phases.complete) {
    ++num_phases[phase.barrier];
    Late& task = late[{phase.barrier, phase.last_task}];
    const std::uint64_t ticks = phase.last - phase.second_to_last;
    ++task.phases;
    task.held_up += ticks;
    task.longest = std::max(task.longest, ticks);
  }
  if (late.empty()) return SkippedText(phases);
  TextTable table({"barrier", "phases", "last task", "came last",
                   "held up (us)", "longest (us)"});
  for (const auto& [key, task] : late) {
    if (!filter.Task(key.second)) continue;
    table.AddRow({std::to_string(key.first),
                  std::to_string(num_phases[key.first]),
                  std::to_string(key.second), std::to_string(task.phases),
                  UsText(history.UsOf(task.held_up)),
                  UsText(history.UsOf(task.longest))});
  }
  return "\nWho came last at a barrier; held up: from the last arrival but one "
         "to its own.\n\n" +
         table.Markdown() + SkippedText(phases);
}

std::string EventsText(const TraceHistory& history, const TraceFilter& filter) {
  struct Posts {
    std::uint64_t posts = 0, ended = 0, longest = 0;
  };
  std::map<ObjectAndTask, Posts> posts;
  for (const TraceRecord& record : history.records) {
    if (record.action != macrotask::TraceAction::kEventPost) continue;
    ++posts[{record.object(), record.task}].posts;
  }
  if (posts.empty()) return "";
  for (const EventWake& wake : FindWakes(history)) {
    Posts& task = posts[{wake.post.object(), wake.post.task}];
    ++task.ended;
    task.longest = std::max(task.longest, wake.wait.end - wake.post.clock);
  }
  TextTable table(
      {"event", "posted by task", "posts", "waits ended", "longest (us)"});
  for (const auto& [key, task] : posts) {
    if (!filter.Task(key.second)) continue;
    table.AddRow({std::to_string(key.first), std::to_string(key.second),
                  std::to_string(task.posts), std::to_string(task.ended),
                  task.ended == 0 ? "" : UsText(history.UsOf(task.longest))});
  }
  return "\nWho posts an event; longest: from EVPOST to the end of "
         "EVWAIT.\n\n" +
         table.Markdown();
}

std::string LocksText(const TraceHistory& history, const TraceFilter& filter) {
  struct Holds {
    std::uint64_t holds = 0, held = 0, longest = 0, contended = 0;
  };
  std::map<ObjectAndTask, Holds> holds;
  for (const LockHold& hold : FindHolds(history)) {
    Holds& task = holds[{hold.lock, hold.task}];
    const std::uint64_t ticks = hold.end - hold.begin;
    ++task.holds;
    task.held += ticks;
    task.longest = std::max(task.longest, ticks);
    task.contended += hold.contended;
  }
  if (holds.empty()) return "";
  TextTable table({"lock", "held by task", "times", "held (us)", "longest (us)",
                   "while others wait (us)"});
  for (const auto& [key, task] : holds) {
    if (!filter.Task(key.second)) continue;
    table.AddRow({std::to_string(key.first), std::to_string(key.second),
                  std::to_string(task.holds), UsText(history.UsOf(task.held)),
                  UsText(history.UsOf(task.longest)),
                  UsText(history.UsOf(task.contended))});
  }
  return "\nWho holds a lock, from LOCKON end or LOCKTEST to LOCKOFF.\n\n" +
         table.Markdown();
}

}  // namespace

std::string SyncText(const TraceHistory& history, const TraceFilter& filter) {
  std::string text =
      "SYNC: calls and waits by object; a wait that has not ended counts up to "
      "the end\nof the trace.\n\n" +
      ObjectsTable(history, filter);
  const auto shows = [&](macrotask::TraceAction action) {
    return filter.Action(action);
  };
  if (shows(macrotask::TraceAction::kBarrierSync)) {
    text += BarriersText(history, filter);
  }
  if (shows(macrotask::TraceAction::kEventPost)) {
    text += EventsText(history, filter);
  }
  if (shows(macrotask::TraceAction::kLockOn)) {
    text += LocksText(history, filter);
  }
  return text;
}

}  // namespace bench
