#include "macrotask/cray/tuning.h"

#include <atomic>
#include <cctype>
#include <charconv>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <optional>
#include <stdexcept>
#include <system_error>

#include "macrotask/placement.h"
#include "macrotask/trace.h"
#include "macrotask/trace_point.h"
#include "macrotask/worker_pool.h"

namespace macrotask::cray {
namespace {

struct Keyword {
  std::string_view name;
  std::int64_t least, most;
  void (*set)(std::int64_t value);
};

std::atomic<std::int64_t> hold_time_us{
    std::chrono::duration_cast<std::chrono::microseconds>(kDefaultHoldTime)
        .count()};

void SetMaxCpu(std::int64_t value) {
  SetMaxProcessors(static_cast<int>(value));
}

void SetHoldTime(std::int64_t value) {
  hold_time_us.store(value, std::memory_order_relaxed);
}

constexpr std::int64_t kBytesPerWord = 8;

void SetStackWords(std::int64_t value) {
  WorkerPool::TheOne().SetStackSize(
      static_cast<std::size_t>(value * kBytesPerWord));
}

void DoNothing(std::int64_t) {}

constexpr std::int64_t kMost = std::numeric_limits<std::int32_t>::max();

// In the order of TraceAction::kTune.
constexpr Keyword kKeywords[] = {
    {"MAXCPU", 1, kMost, &SetMaxCpu},   {"DBRELEAS", 0, kMost, &DoNothing},
    {"DBACTIVE", 0, kMost, &DoNothing}, {"HOLDTIME", 0, kMost, &SetHoldTime},
    {"SAMPLE", 0, kMost, &DoNothing},   {"STACKSZ", 0, kMost, &SetStackWords},
};

// Without the blanks that Fortran pads with, in upper case.
std::string Normalize(std::string_view text) {
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  std::string upper;
  for (const char c : text) {
    upper += static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  }
  return upper;
}

const Keyword& FindKeyword(const std::string& keyword) {
  std::string expected;
  for (const Keyword& known : kKeywords) {
    if (known.name == Normalize(keyword)) return known;
    expected += (expected.empty() ? "" : ", ") + std::string(known.name);
  }
  throw std::runtime_error("unknown keyword '" + keyword +
                           "': expected one of " + expected);
}

void CheckRange(const Keyword& keyword, std::int64_t value) {
  const bool good = value >= keyword.least && value <= keyword.most;
  // A stack that the system would refuse.
  constexpr std::int64_t kLeastStackWords = 2048;
  const bool too_small =
      keyword.set == &SetStackWords && value != 0 && value < kLeastStackWords;
  if (good && !too_small) return;
  const std::int64_t least = too_small ? kLeastStackWords : keyword.least;
  throw std::runtime_error(std::string(keyword.name) + " of " +
                           std::to_string(value) + ": expected " +
                           (too_small ? "0 or " : "") + std::to_string(least) +
                           " to " + std::to_string(keyword.most));
}

// What MACROTASK_WAIT says. A bad value ends the program at the first call that
// wants to know.
std::optional<WaitKind> WaitKindOfEnvironment() {
  const char* const name = std::getenv("MACROTASK_WAIT");
  if (name == nullptr || *name == '\0') return std::nullopt;
  const auto kind = ParseWaitKind(name);
  if (!kind || kind == WaitKind::kLogical || kind == WaitKind::kAuto) {
    throw std::runtime_error(std::string("MACROTASK_WAIT is '") + name +
                             "': expected block, spin or hold");
  }
  return kind;
}

}  // namespace

WaitPolicy TunedPolicy() {
  static const std::optional<WaitKind> given = WaitKindOfEnvironment();
  const std::chrono::microseconds hold_time(
      hold_time_us.load(std::memory_order_relaxed));
  const WaitKind tuned =
      hold_time.count() == 0 ? WaitKind::kBlock : WaitKind::kHold;
  return {given.value_or(tuned), hold_time};
}

void Tune(const std::vector<TuningPair>& pairs) {
  for (const TuningPair& pair : pairs) {
    CheckRange(FindKeyword(pair.keyword), pair.value);
  }
  for (const TuningPair& pair : pairs) {
    const Keyword& keyword = FindKeyword(pair.keyword);
    keyword.set(pair.value);
    RecordIf(TraceClass::kInfo, TraceAction::kTune,
             TraceData(static_cast<std::uint32_t>(pair.value),
                       static_cast<std::uint64_t>(&keyword - kKeywords) + 1));
  }
}

void TuneTrace(std::string_view keyword, std::string_view value) {
  const std::string name = Normalize(keyword);
  while (!value.empty() && value.back() == ' ') value.remove_suffix(1);
  if (name == "DN") {
    SetTraceFile(std::string(value));
    if (TraceClasses() == 0 && !value.empty()) {
      SetTraceClasses(kAllTraceClasses);
    }
    return;
  }
  if (name == "SIZE") {
    std::size_t size = 0;
    const char* const end = value.data() + value.size();
    const auto [rest, error] = std::from_chars(value.data(), end, size);
    if (rest != end || error != std::errc() || value.empty()) {
      throw std::runtime_error("SIZE of '" + std::string(value) +
                               "': expected a number of records");
    }
    return SetTraceSize(size);
  }
  const auto trace_class = ParseTraceClass(name);
  if (!trace_class) {
    throw std::runtime_error(
        "unknown keyword '" + std::string(keyword) +
        "': expected one of DN, TASKS, LOCKS, EVENTS, CPUS, USERS, INFO, SIZE");
  }
  const std::string on_off = Normalize(value);
  if (on_off != "ON" && on_off != "OFF") {
    throw std::runtime_error(name + " of '" + std::string(value) +
                             "': expected ON or OFF");
  }
  const auto bit = static_cast<std::uint32_t>(*trace_class);
  SetTraceClasses(on_off == "ON" ? TraceClasses() | bit
                                 : TraceClasses() & ~bit);
}

void DumpTrace() {
  const std::string path = TraceFile();
  WriteTrace(TakeTrace(), path.empty() ? "macrotask.trace" : path);
}

}  // namespace macrotask::cray
