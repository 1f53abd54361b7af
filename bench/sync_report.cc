#include "bench/sync_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "bench/text_table.h"
#include "macrotask/placement.h"

namespace bench {
namespace {

std::string Nano(double seconds) {
  const double ns = seconds * 1e9;
  return std::abs(ns) < 99.95 ? fmt::format("{:.1f}", ns)
                              : fmt::format("{:.0f}", ns);
}

std::string IntervalCell(const std::optional<Summary>& summary) {
  if (!summary) return "";
  return fmt::format("{} [{}, {}]", Nano(summary->median),
                     Nano(summary->interval.low), Nano(summary->interval.high));
}

std::string HeaderText(const SyncResult& r) {
  std::string text = fmt::format(
      "macrotask {} ({})\n"
      "processor:  {}, {} usable\n"
      "kernel:     {}\n"
      "compiler:   {}, {}\n"
      "placement:  {}\n",
      r.machine.version, r.machine.git_hash, r.machine.cpu,
      r.machine.processors, r.machine.kernel, r.machine.compiler,
      r.machine.flags,
      r.axes.placement == SyncPlacement::kPinned
          ? "pinned, neighbours together if there are too few processors"
          : "free, the system chooses");
  if (r.clocks) {
    text += fmt::format(
        "clocks:     {} (messages took {} ns there, {} ns back)\n",
        r.clocks->agree() ? "the same on both processors"
                          : "NOT the same, do not believe latencies",
        Nano(r.clocks->there), Nano(r.clocks->back));
  }
  return text;
}

std::string DistanceText(const DistanceSplit& split,
                         const std::vector<double>& round_trips) {
  std::vector<double> near, far;
  for (const double trip : round_trips) {
    (split.Of(trip) == Distance::kFar ? far : near).push_back(trip);
  }
  if (near.empty()) return "";
  const auto range = [](const std::vector<double>& trips) {
    return fmt::format("{} ns ({} to {})", Nano(Median(trips)),
                       Nano(Percentile(trips, 0.05)),
                       Nano(Percentile(trips, 0.95)));
  };
  if (far.empty()) {
    return fmt::format(
        "distance:   a cache line went to the other processor and back in {}, "
        "always\n",
        range(near));
  }
  return fmt::format(
      "distance:   a cache line went to the other processor and back in {},\n"
      "            near, or in {}, far ({:.0f} % of the time)\n",
      range(near), range(far),
      100.0 * static_cast<double>(far.size()) /
          static_cast<double>(round_trips.size()));
}

bool HasProcessorEach(const SyncRow& row, const SyncResult& r) {
  return row.variant.num_tasks <= r.machine.processors;
}

std::string OverheadCell(const SyncRow& row) {
  if (!row.variant.missing.empty()) return row.variant.missing;
  return row.overhead ? IntervalCell(row.overhead) : "all disturbed";
}

std::string LatencyCell(const SyncRow& row) {
  if (!row.last) return "";
  return row.first ? Nano(row.first->median) + " to " + Nano(row.last->median)
                   : Nano(row.last->median);
}

// The columns that a family has beyond those of all.
struct Columns {
  bool tasks, points, latency, fairness;
};

Columns ColumnsOf(SyncFamily family) {
  return {.tasks = family != SyncFamily::kLimit,
          .points = family != SyncFamily::kLimit && family != SyncFamily::kTask,
          .latency = true,
          .fairness = family == SyncFamily::kLock};
}

std::vector<std::string> HeaderCells(const Columns& columns, bool distances) {
  std::vector<std::string> cells = {"construct", "by"};
  if (columns.tasks) cells.push_back("tasks");
  if (columns.points) cells.insert(cells.end(), {"work (us)", "skew"});
  if (distances) cells.push_back("distance");
  cells.insert(cells.end(),
               {"overhead (ns) [95 %]", "min", "p95", "latency (ns)"});
  if (columns.fairness) cells.push_back("fairness");
  cells.insert(cells.end(), {"n", "dropped"});
  return cells;
}

std::vector<std::string> RowCells(const SyncRow& row, const Columns& columns,
                                  bool distances, const SyncResult& r) {
  const Variant& variant = row.variant;
  std::vector<std::string> cells = {variant.construct, variant.by};
  if (columns.tasks) {
    cells.push_back(fmt::format("{}{}", variant.num_tasks,
                                HasProcessorEach(row, r) ? "" : " (crowded)"));
  }
  if (columns.points) {
    cells.push_back(fmt::format("{:g}", variant.work));
    cells.emplace_back(Name(variant.skew));
  }
  if (distances) cells.emplace_back(Name(row.distance));
  cells.push_back(OverheadCell(row));
  cells.push_back(row.overhead ? Nano(row.overhead->min) : "");
  cells.push_back(row.overhead ? Nano(row.overhead->p95) : "");
  cells.push_back(LatencyCell(row));
  if (columns.fairness) {
    cells.push_back(row.fairness ? fmt::format("{:.2f}", row.fairness->median)
                                 : "");
  }
  cells.push_back(row.overhead ? fmt::format("{}", row.overhead->n) : "");
  cells.push_back(row.variant.missing.empty()
                      ? fmt::format("{}", row.dropped.total())
                      : "");
  return cells;
}

const char* TitleOf(SyncFamily family) {
  switch (family) {
    case SyncFamily::kBarrier:
      return "Barriers. Latency: from the last arrival to the last departure.";
    case SyncFamily::kEvent:
      return "Events. Overhead: one way, half of a post to all waiters and one "
             "back. Latency:\nfrom the post to the return of the first and of "
             "the last waiter.";
    case SyncFamily::kLock:
      return "Locks. Overhead: an acquisition, with the work inside. Latency: "
             "from the release to\nthe return of another task that was "
             "waiting. Fairness: acquisitions of the task that\ngot the fewest "
             "over those of the one that got the most, in a race.";
    case SyncFamily::kTask:
      return "Tasks. Overhead: all started and waited for. Latency: from the "
             "first start to the\nfirst instruction of the first and of the "
             "last task.";
    case SyncFamily::kLimit:
      return "Limits of the machine. Futex: overhead of the waker, latency to "
             "the first\ninstruction of the one woken.";
  }
  return "";
}

std::string FamilyText(SyncFamily family, const SyncResult& r) {
  const Columns columns = ColumnsOf(family);
  const bool distances = r.split.has_two();
  TextTable table(HeaderCells(columns, distances));
  bool any = false;
  for (const SyncRow& row : r.rows) {
    if (row.variant.family != family) continue;
    table.AddRow(RowCells(row, columns, distances, r));
    any = true;
  }
  if (!any) return "";
  return std::string("\n") + TitleOf(family) + "\n\n" + table.Markdown();
}

std::string DroppedText(const SyncResult& r) {
  Dropped all;
  int kept = 0;
  for (const SyncRow& row : r.rows) {
    all.distance += row.dropped.distance;
    all.stolen += row.dropped.stolen;
    all.switched += row.dropped.switched;
    kept += row.overhead ? row.overhead->n : 0;
  }
  return fmt::format(
      "\nOf {} samples {} were dropped as disturbed: in {} another guest had a "
      "processor, in {}\nanother thread, in {} the distance changed. {} "
      "repetitions, variants in turn; brackets:\n95 % intervals of the "
      "medians. Overhead: a loop of work and construct less the loop of work\n"
      "alone in the same repetition.\n",
      kept + all.total(), all.total(), all.stolen, all.switched, all.distance,
      r.repetitions);
}

std::string WorkCell(const BreakEvenRow& row, const WorkSummary& work,
                     const BreakEven& even) {
  if (row.n == 0) return "all disturbed";
  const auto text = [&](const std::optional<double>& seconds) {
    return seconds ? DurationText(*seconds)
                   : "> " + DurationText(even.most_work);
  };
  return fmt::format("{} [{}, {}]", text(work.median), text(work.low),
                     text(work.high));
}

// The best of ours, which bear the names of the ways to wait, at one distance.
std::string BreakEvenSentence(const BreakEven& even, Distance distance) {
  const BreakEvenRow* best = nullptr;
  for (const BreakEvenRow& row : even.rows) {
    const bool ours = macrotask::ParseWaitKind(row.by).has_value();
    if (!ours || row.distance != distance || !row.half.median) continue;
    if (best == nullptr || *row.half.median < *best->half.median) best = &row;
  }
  if (best == nullptr) return "";
  const std::string where =
      distance == Distance::kOnly
          ? ""
          : fmt::format(" while the processors are {}", Name(distance));
  return fmt::format(
      "On this machine{} two tasks that meet at a barrier ({}) gain if each "
      "has more than {}\nof work between two of them, and lose less than a "
      "tenth from {} on.\n",
      where, best->by, DurationText(*best->half.median),
      best->ninety.median ? DurationText(*best->ninety.median)
                          : "more than " + DurationText(even.most_work));
}

std::string BreakEvenText(const BreakEven& even) {
  std::vector<std::string> header = {"construct", "by"};
  if (even.split.has_two()) header.push_back("distance");
  header.insert(header.end(), {"work for 50 % [95 %]", "work for 90 % [95 %]",
                               "n", "dropped"});
  TextTable table(header);
  for (const BreakEvenRow& row : even.rows) {
    std::vector<std::string> cells = {row.construct, row.by};
    if (even.split.has_two()) cells.emplace_back(Name(row.distance));
    cells.push_back(WorkCell(row, row.half, even));
    cells.push_back(WorkCell(row, row.ninety, even));
    cells.push_back(fmt::format("{}", row.n));
    cells.push_back(fmt::format("{}", row.dropped));
    table.AddRow(std::move(cells));
  }
  std::string text =
      "\nHow small the work between two barriers may be. Two tasks, each with "
      "that work; efficiency:\nthe time of one task for both works over twice "
      "the time of the two tasks. At 50 % they are\nas fast as one. Where the "
      "median over the repetitions reaches it for good; brackets: where the\n"
      "bounds of its 95 % interval do.\n\n" +
      table.Markdown() + "\n";
  for (const Distance distance :
       {Distance::kOnly, Distance::kNear, Distance::kFar}) {
    text += BreakEvenSentence(even, distance);
  }
  return text;
}

}  // namespace

std::string DurationText(double seconds) {
  constexpr std::array<std::pair<double, const char*>, 3> kUnits = {
      {{1e-3, "ms"}, {1e-6, "us"}, {1e-9, "ns"}}};
  for (const auto& [unit, name] : kUnits) {
    if (seconds >= unit || unit == kUnits.back().first) {
      return fmt::format("{:.3g} {}", seconds / unit, name);
    }
  }
  return "";
}

std::string RowName(const SyncRow& row) {
  const Variant& variant = row.variant;
  std::string name = fmt::format(
      "{}/{}/tasks:{}/work_us:{:g}/skew:{}", variant.construct, variant.by,
      variant.num_tasks, variant.work, Name(variant.skew));
  if (row.distance != Distance::kOnly) {
    name += fmt::format("/{}", Name(row.distance));
  }
  return name;
}

std::string SyncText(const SyncResult& r) {
  const DistanceSplit& split = r.break_even ? r.break_even->split : r.split;
  std::string text = HeaderText(r) + DistanceText(split, r.round_trips);
  if (r.break_even) return text + BreakEvenText(*r.break_even);
  for (const SyncFamily family :
       {SyncFamily::kBarrier, SyncFamily::kEvent, SyncFamily::kLock,
        SyncFamily::kTask, SyncFamily::kLimit}) {
    text += FamilyText(family, r);
  }
  return text + DroppedText(r);
}

}  // namespace bench
