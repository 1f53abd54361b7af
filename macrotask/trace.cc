#include "macrotask/trace.h"

#include <algorithm>
#include <bit>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <stdexcept>
#include <thread>

#include "macrotask/clock.h"
#include "macrotask/mutex.h"
#include "macrotask/placement.h"
#include "macrotask/task_registry.h"
#include "macrotask/trace_point.h"
#include "macrotask/trace_ring.h"

namespace macrotask {
namespace {

// The same moment on the clock of the trace and on the system's.
struct Moment {
  std::uint64_t clock = 0;
  std::chrono::steady_clock::time_point time;
};

Moment Now() {
  // The closest of a few, as this may be interrupted between the readings.
  Moment best;
  std::uint64_t best_width = ~std::uint64_t{0};
  for (int i = 0; i < 8; ++i) {
    const std::uint64_t before = ReadStamp().clock;
    const auto time = std::chrono::steady_clock::now();
    const std::uint64_t width = ReadStamp().clock - before;
    if (width >= best_width) continue;
    best_width = width;
    best = {before + width / 2, time};
  }
  return best;
}

// Of the whole process; never destroyed, as tasks may outlive static objects.
struct Setting {
  Mutex mutex;  // guards all below
  bool begun = false;
  Moment first;
  std::int64_t first_unix_ns = 0;
  std::string file;
  bool writes_at_exit = false;
};

Setting& TheSetting() {
  static Setting* const setting = new Setting;
  return *setting;
}

std::atomic<std::size_t> ring_size{kDefaultTraceSize};

void WriteAtExit() {
  const std::string path = TraceFile();
  if (path.empty()) return;
  try {
    WriteTrace(TakeTrace(), path);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "macrotask: %s\n", error.what());
  }
}

// Ticks per second, from the two moments; waits until they are far enough apart
// for five digits.
double CalcTickRate(const Moment& first) {
  constexpr auto kEnough = std::chrono::milliseconds(10);
  const auto passed = std::chrono::steady_clock::now() - first.time;
  if (passed < kEnough) std::this_thread::sleep_for(kEnough - passed);
  const Moment last = Now();
  return static_cast<double>(last.clock - first.clock) /
         std::chrono::duration<double>(last.time - first.time).count();
}

[[gnu::noinline, gnu::cold]] TraceRing& MakeRing(TaskRecord& record) {
  auto* const ring = new TraceRing(ring_size.load(std::memory_order_relaxed));
  // Release: partner of the acquire in TakeTrace().
  record.trace.store(ring, std::memory_order_release);
  return *ring;
}

TraceRing& RingOfCaller() {
  TaskRecord& record = RecordOfCaller();
  TraceRing* const ring = record.trace.load(std::memory_order_relaxed);
  return ring != nullptr ? *ring : MakeRing(record);
}

bool IsLean() {
  return (traced_classes.load(std::memory_order_relaxed) & kLeanTrace) != 0;
}

bool HoldsNobody(TraceAction action, std::uint64_t data) {
  const bool is_barrier = action == TraceAction::kBarrierSync ||
                          action == TraceAction::kBarrierSyncEnd;
  const bool is_test = action == TraceAction::kEventTest ||
                       action == TraceAction::kEventTestClear ||
                       action == TraceAction::kLockTestSet;
  return action == TraceAction::kEventClear || is_test ||
         (is_barrier && data >> 32 == 1);
}

[[gnu::noinline, gnu::cold]] void RecordFirst(TraceAction action,
                                              std::uint64_t data) {
  TraceRing& ring = RingOfCaller();
  const Stamp stamp = ReadStampAhead();
  ring.Append({stamp.clock, data, number_of_caller, stamp.cpu, action});
}

// Calls nothing but what the first record needs, so that it saves no registers:
// others wait meanwhile.
void RecordLean(TraceAction action, std::uint64_t data) {
  if (HoldsNobody(action, data)) return;
  const TaskRecord* const record = record_of_caller;
  TraceRing* const ring = record == nullptr
                              ? nullptr
                              : record->trace.load(std::memory_order_relaxed);
  if (ring == nullptr) [[unlikely]] {
    return RecordFirst(action, data);
  }
  const Stamp stamp = ReadStampAhead();
  ring->AppendNext({stamp.clock, data, number_of_caller, stamp.cpu, action});
}

[[maybe_unused]] const bool environment_is_read = [] {
  const char* const path = std::getenv("MACROTASK_TRACE");
  if (path == nullptr || *path == '\0') return false;
  SetTraceFile(path);
  SetTraceClasses(kAllTraceClasses);
  return true;
}();

}  // namespace

void SetTraceClasses(std::uint32_t classes) {
  Setting& setting = TheSetting();
  {
    const MutexGuard guard(setting.mutex);
    if (!setting.begun && classes != 0) {
      setting.begun = true;
      setting.first = Now();
      setting.first_unix_ns =
          std::chrono::duration_cast<std::chrono::nanoseconds>(
              std::chrono::system_clock::now().time_since_epoch())
              .count();
    }
    traced_classes.store(classes & (kAllTraceClasses | kLeanTrace),
                         std::memory_order_relaxed);
  }
  RecordIf(TraceClass::kInfo, TraceAction::kTraceClasses, classes);
}

std::uint32_t TraceClasses() {
  return traced_classes.load(std::memory_order_relaxed);
}

void SetTraceSize(std::size_t num_records) {
  if (num_records < 2 || num_records > (std::size_t{1} << 28)) {
    throw std::invalid_argument("a history trace of " +
                                std::to_string(num_records) +
                                " records: expected 2 to 268435456");
  }
  ring_size.store(std::bit_ceil(num_records), std::memory_order_relaxed);
}

void RecordUser(std::int64_t action, std::uint64_t data) {
  if (action < kFirstUserAction || action > kLastUserAction) {
    throw std::invalid_argument("user action " + std::to_string(action) +
                                ": expected 65 to 128");
  }
  RecordIf(TraceClass::kUsers, static_cast<TraceAction>(action), data);
}

void Record(TraceAction action, std::uint64_t data) {
  if (IsLean()) return RecordLean(action, data);
  TraceRing& ring = RingOfCaller();
  const Stamp stamp = ReadStamp();
  ring.Append({stamp.clock, data, number_of_caller, stamp.cpu, action});
}

Trace TakeTrace() {
  Setting& setting = TheSetting();
  Trace trace;
  trace.last_clock = ReadStamp().clock;
  {
    const MutexGuard guard(setting.mutex);
    if (!setting.begun) return trace;
    trace.first_clock = setting.first.clock;
    trace.first_unix_ns = setting.first_unix_ns;
    trace.ticks_per_second = CalcTickRate(setting.first);
  }
  trace.num_processors = static_cast<std::uint32_t>(NumProcessors());
  trace.classes = TraceClasses() & kAllTraceClasses;
  for (const TaskRecord* record = TaskRegistry::TheOne().first();
       record != nullptr; record = record->next()) {
    // Acquire: partner of the release in RingOf().
    const TraceRing* const ring = record->trace.load(std::memory_order_acquire);
    if (ring == nullptr) continue;
    TraceBuffer buffer;
    buffer.task = record->number();
    buffer.value = record->value();
    buffer.records = ring->Read(&buffer.num_lost);
    // What was written since the moment of the trace.
    while (!buffer.records.empty() &&
           buffer.records.back().clock > trace.last_clock) {
      buffer.records.pop_back();
    }
    trace.buffers.push_back(std::move(buffer));
  }
  return trace;
}

void SetTraceFile(const std::string& path) {
  Setting& setting = TheSetting();
  const MutexGuard guard(setting.mutex);
  setting.file = path;
  if (path.empty() || setting.writes_at_exit) return;
  setting.writes_at_exit = true;
  std::atexit(&WriteAtExit);
}

std::string TraceFile() {
  Setting& setting = TheSetting();
  const MutexGuard guard(setting.mutex);
  return setting.file;
}

}  // namespace macrotask
