#include "bench/predict/trace_program.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

#include "bench/predict/step_reader.h"
#include "macrotask/trace.h"

namespace bench::predict {
namespace {

using macrotask::TraceClass;
using macrotask::TraceRecord;
using enum macrotask::TraceAction;

using RecordsByTask = std::map<std::uint32_t, std::vector<TraceRecord>>;

void CheckClasses(std::uint32_t classes, std::string_view name) {
  for (const TraceClass needed :
       {TraceClass::kTasks, TraceClass::kLocks, TraceClass::kEvents}) {
    if ((classes & static_cast<std::uint32_t>(needed)) != 0) continue;
    throw std::runtime_error(fmt::format(
        "{} was recorded without {}: expected TASKS, LOCKS and EVENTS from "
        "beginning to end",
        name, Name(needed)));
  }
  if ((classes & macrotask::kLeanTrace) != 0) {
    throw std::runtime_error(fmt::format(
        "{} was recorded as a lean trace: expected a full one", name));
  }
}

// What was recorded matters only while something was: the Cray calls switch
// classes on one by one.
void CheckRecording(const TraceHistory& history, std::string_view name) {
  std::uint32_t classes = macrotask::kAllTraceClasses;
  for (const TraceRecord& record : history.records) {
    if (record.action == kTraceClasses) {
      classes = record.object();
    } else if (ClassOf(record.action) != TraceClass::kInfo) {
      CheckClasses(classes, name);
    }
  }
  CheckClasses(history.trace.classes, name);
  if (history.num_lost > 0) {
    throw std::runtime_error(fmt::format(
        "{} has lost {} record{}: expected a trace that has them all", name,
        history.num_lost, history.num_lost == 1 ? "" : "s"));
  }
}

RecordsByTask Divide(const TraceHistory& history, std::string_view name) {
  RecordsByTask tasks;
  for (const TraceRecord& record : history.records) {
    tasks[record.task].push_back(record);
  }
  // A pthread that has no task yet has the number 0; one that waits for its
  // next task, the number of its last one.
  std::erase_if(tasks, [](const auto& task) {
    return std::all_of(
        task.second.begin(), task.second.end(), [](const TraceRecord& record) {
          return record.action == kSleep || record.action == kWake;
        });
  });
  if (!tasks.empty()) return tasks;
  throw std::runtime_error(
      fmt::format("{} has no records: expected those of a task", name));
}

std::set<std::uint32_t> FindStarted(const TraceHistory& history,
                                    std::string_view name) {
  std::set<std::uint32_t> started;
  for (const TraceRecord& record : history.records) {
    if (record.action != kTaskStart) continue;
    if (started.insert(record.object()).second) continue;
    throw std::runtime_error(
        fmt::format("{} shows that task {} is started twice: expected once",
                    name, record.object()));
  }
  return started;
}

std::map<std::uint32_t, int> IndexTasks(const RecordsByTask& tasks) {
  std::map<std::uint32_t, int> indices;
  for (const auto& [number, records] : tasks) {
    indices.emplace(number, static_cast<int>(indices.size()));
  }
  return indices;
}

void TakeObjects(const StepReader& reader, std::string_view name,
                 Program* program) {
  try {
    reader.TakeObjects(program);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(fmt::format("{} shows that {}", name,  //
                                         error.what()));
  }
}

}  // namespace

Program ProgramOf(const TraceHistory& history, std::string_view name,
                  double record_seconds) {
  CheckRecording(history, name);
  const RecordsByTask tasks = Divide(history, name);
  const std::set<std::uint32_t> started = FindStarted(history, name);
  const double ticks_per_second = history.trace.ticks_per_second;
  StepReader reader(ticks_per_second, record_seconds, IndexTasks(tasks));
  Program program;
  for (const auto& [number, records] : tasks) {
    TaskProgram task;
    task.started = started.contains(number);
    const std::uint64_t ticks =
        records.front().clock - history.records.front().clock;
    if (!task.started && ticks > 0) {
      task.head.push_back(Compute(
          Block::kOther, static_cast<double>(ticks) / ticks_per_second));
    }
    const std::vector<Step> steps = reader.Read(records);
    task.head.insert(task.head.end(), steps.begin(), steps.end());
    program.tasks.push_back(std::move(task));
  }
  TakeObjects(reader, name, &program);
  return program;
}

}  // namespace bench::predict
