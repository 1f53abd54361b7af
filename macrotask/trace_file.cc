#include "macrotask/trace_file.h"

#include <bit>
#include <stdexcept>

#include "macrotask/whole_file.h"

namespace macrotask {
namespace {

constexpr std::string_view kMagic = "MTHISTRY";
constexpr std::uint32_t kVersion = 1;
constexpr std::size_t kHeaderSize = 72;
constexpr std::size_t kBufferHeaderSize = 32;
constexpr std::size_t kRecordSize = 24;

template <typename Unsigned>
void Put(std::string* bytes, Unsigned value) {
  for (std::size_t i = 0; i < sizeof value; ++i) {
    *bytes += static_cast<char>(value >> (8 * i) & 0xff);
  }
}

// Takes numbers from the front of a text that is known to be long enough.
class Taker {
 public:
  explicit Taker(std::string_view bytes) : rest_(bytes) {}

  template <typename Unsigned>
  Unsigned Take() {
    Unsigned value = 0;
    for (std::size_t i = 0; i < sizeof value; ++i) {
      const auto byte = static_cast<unsigned char>(rest_[i]);
      value =
          static_cast<Unsigned>(value | static_cast<Unsigned>(byte) << (8 * i));
    }
    rest_.remove_prefix(sizeof value);
    return value;
  }
  std::uint32_t U32() { return Take<std::uint32_t>(); }
  std::uint64_t U64() { return Take<std::uint64_t>(); }

  std::size_t size() const { return rest_.size(); }

 private:
  std::string_view rest_;
};

std::size_t SizeOf(const Trace& trace) {
  std::size_t size = kHeaderSize;
  for (const TraceBuffer& buffer : trace.buffers) {
    size += kBufferHeaderSize + kRecordSize * buffer.records.size();
  }
  return size;
}

TraceRecord TakeRecord(Taker* taker) {
  TraceRecord record;
  record.clock = taker->U64();
  record.data = taker->U64();
  record.task = taker->U32();
  record.cpu = taker->Take<std::uint16_t>();
  record.action = static_cast<TraceAction>(taker->Take<std::uint16_t>());
  return record;
}

[[noreturn]] void Fail(std::string_view name, const std::string& what) {
  throw std::runtime_error(std::string(name) + " " + what);
}

// Returns what follows the sizes in the header.
Taker CheckHeader(std::string_view bytes, std::string_view name) {
  if (!bytes.starts_with(kMagic)) {
    Fail(name, "is no history trace: it does not begin with MTHISTRY");
  }
  Taker taker(bytes.substr(kMagic.size()));
  const std::uint32_t version =
      taker.size() >= sizeof version ? taker.U32() : kVersion;
  if (version != kVersion) {
    Fail(name, "has version " + std::to_string(version) +
                   " of the trace format: expected version 1");
  }
  if (bytes.size() < kHeaderSize) {
    Fail(name, "is truncated: " + std::to_string(bytes.size()) +
                   " bytes, less than the header's 72");
  }
  const std::uint32_t record_size = taker.U32();
  if (record_size != kRecordSize) {
    Fail(name, "is damaged: records of " + std::to_string(record_size) +
                   " bytes, expected 24");
  }
  const std::uint64_t size = taker.U64();
  if (size != bytes.size()) {
    Fail(name,
         std::string(bytes.size() < size ? "is truncated: " : "is damaged: ") +
             std::to_string(bytes.size()) + " bytes, expected " +
             std::to_string(size));
  }
  return taker;
}

TraceBuffer TakeBuffer(Taker* taker, std::string_view name) {
  if (taker->size() < kBufferHeaderSize) {
    Fail(name, "is damaged: a buffer begins after its end");
  }
  TraceBuffer buffer;
  buffer.task = taker->U32();
  taker->U32();
  buffer.value = taker->U64();
  buffer.num_lost = taker->U64();
  const std::uint64_t num_records = taker->U64();
  if (num_records > taker->size() / kRecordSize) {
    Fail(name, "is damaged: a buffer of " + std::to_string(num_records) +
                   " records does not fit into it");
  }
  buffer.records.reserve(num_records);
  for (std::uint64_t i = 0; i < num_records; ++i) {
    buffer.records.push_back(TakeRecord(taker));
  }
  return buffer;
}

}  // namespace

double Trace::Seconds(std::uint64_t clock) const {
  // Signed: a task may have read its clock just before recording was on.
  return static_cast<double>(static_cast<std::int64_t>(clock - first_clock)) /
         ticks_per_second;
}

std::string EncodeTrace(const Trace& trace) {
  std::string bytes(kMagic);
  bytes.reserve(SizeOf(trace));
  Put(&bytes, kVersion);
  Put(&bytes, static_cast<std::uint32_t>(kRecordSize));
  Put(&bytes, static_cast<std::uint64_t>(SizeOf(trace)));
  Put(&bytes, std::bit_cast<std::uint64_t>(trace.ticks_per_second));
  Put(&bytes, trace.first_clock);
  Put(&bytes, trace.last_clock);
  Put(&bytes, static_cast<std::uint64_t>(trace.first_unix_ns));
  Put(&bytes, trace.num_processors);
  Put(&bytes, trace.classes);
  Put(&bytes, static_cast<std::uint32_t>(trace.buffers.size()));
  Put(&bytes, std::uint32_t{0});
  for (const TraceBuffer& buffer : trace.buffers) {
    Put(&bytes, buffer.task);
    Put(&bytes, std::uint32_t{0});
    Put(&bytes, buffer.value);
    Put(&bytes, buffer.num_lost);
    Put(&bytes, static_cast<std::uint64_t>(buffer.records.size()));
    for (const TraceRecord& record : buffer.records) {
      Put(&bytes, record.clock);
      Put(&bytes, record.data);
      Put(&bytes, record.task);
      Put(&bytes, record.cpu);
      Put(&bytes, static_cast<std::uint16_t>(record.action));
    }
  }
  return bytes;
}

Trace DecodeTrace(std::string_view bytes, std::string_view name) {
  Taker taker = CheckHeader(bytes, name);
  Trace trace;
  trace.ticks_per_second = std::bit_cast<double>(taker.U64());
  if (!(trace.ticks_per_second >= 1 && trace.ticks_per_second < 1e15)) {
    Fail(name, "is damaged: a clock of " +
                   std::to_string(trace.ticks_per_second) +
                   " ticks per second");
  }
  trace.first_clock = taker.U64();
  trace.last_clock = taker.U64();
  trace.first_unix_ns = static_cast<std::int64_t>(taker.U64());
  trace.num_processors = taker.U32();
  trace.classes = taker.U32();
  const std::uint32_t num_buffers = taker.U32();
  taker.U32();
  for (std::uint32_t i = 0; i < num_buffers; ++i) {
    trace.buffers.push_back(TakeBuffer(&taker, name));
  }
  if (taker.size() != 0) {
    Fail(name, "is damaged: " + std::to_string(taker.size()) +
                   " bytes after the last buffer");
  }
  return trace;
}

void WriteTrace(const Trace& trace, const std::string& path) {
  WriteWholeFile(path, EncodeTrace(trace));
}

Trace ReadTrace(const std::string& path) {
  return DecodeTrace(ReadWholeFile(path), "'" + path + "'");
}

}  // namespace macrotask
