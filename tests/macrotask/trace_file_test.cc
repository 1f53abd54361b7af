#include "macrotask/trace_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <set>
#include <stdexcept>
#include <string>

namespace macrotask {
namespace {

namespace fs = std::filesystem;

// Places in the file, and the sizes of its parts; see trace_file.h.
constexpr std::size_t kVersionAt = 8, kRecordSizeAt = 12, kTicksAt = 24,
                      kNumBuffersAt = 64, kNumRecordsAt = 72 + 24;
constexpr std::size_t kHeader = 72, kBufferHeader = 32, kRecord = 24;

Trace ExampleTrace() {
  Trace trace;
  trace.ticks_per_second = 2.5e9;
  trace.first_clock = 1'000;
  trace.last_clock = 0xfedc'ba98'7654'3210;
  trace.first_unix_ns = -1;
  trace.num_processors = 8;
  trace.classes = kAllTraceClasses;
  trace.buffers.resize(3);
  trace.buffers[0] = {
      1,
      0,
      12'345'678'901,
      {{1'000, 63, 1, 0, TraceAction::kTraceClasses},
       {2'000, 4ull << 32 | 3, 1, 65'535, TraceAction::kBarrierSync}}};
  trace.buffers[1] = {2, 0x4d52'4120'3130'3030, 0, {}};
  trace.buffers[2] = {
      4'294'967'295, 7, 1, {{5, ~0ull, 4'294'967'295, 1, TraceAction{128}}}};
  return trace;
}

// What `action` throws, or "".
template <typename Action>
std::string MessageOf(const Action& action) {
  try {
    action();
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

std::string DecodingError(const std::string& bytes) {
  return MessageOf([&] { DecodeTrace(bytes, "it"); });
}

template <typename Number>
std::string With(std::string bytes, std::size_t place, Number number) {
  std::memcpy(bytes.data() + place, &number, sizeof number);
  return bytes;
}

TEST(EncodeTrace, IsTheInverseOfDecodeTrace) {
  EXPECT_EQ(DecodeTrace(EncodeTrace(ExampleTrace()), "it"), ExampleTrace());
  EXPECT_EQ(DecodeTrace(EncodeTrace(Trace()), "it"), Trace());
}

TEST(EncodeTrace, PlacesNumbersAsTheHeaderSays) {
  const std::string bytes = EncodeTrace(ExampleTrace());
  ASSERT_EQ(bytes.size(), kHeader + 3 * kBufferHeader + 3 * kRecord);
  EXPECT_EQ(bytes.substr(0, 8), "MTHISTRY");
  // Little-endian on any machine: version, size of a record, of the file.
  EXPECT_EQ(bytes.substr(8, 16),
            std::string("\1\0\0\0\30\0\0\0\xf0\0\0\0\0\0\0\0", 16));
  EXPECT_EQ(bytes.substr(40, 8), "\x10\x32\x54\x76\x98\xba\xdc\xfe");
  // The first record of the first buffer: clock, data, task, processor, action.
  EXPECT_EQ(bytes.substr(kHeader + kBufferHeader, kRecord),
            std::string("\xe8\3\0\0\0\0\0\0\77\0\0\0\0\0\0\0\1\0\0\0\0\0\62\0",
                        kRecord));
}

TEST(DecodeTrace, EveryTruncationIsOneSentence) {
  const std::string bytes = EncodeTrace(ExampleTrace());
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    const std::string error = DecodingError(bytes.substr(0, size));
    const std::string number = std::to_string(size);
    EXPECT_EQ(error, size < 8 ? "it is no history trace: it does not begin "
                                "with MTHISTRY"
                     : size < kHeader ? "it is truncated: " + number +
                                            " bytes, less than the header's 72"
                                      : "it is truncated: " + number +
                                            " bytes, expected 240");
  }
}

TEST(DecodeTrace, OtherFilesAreNamedAsWhatTheyAre) {
  const std::string bytes = EncodeTrace(ExampleTrace());
  EXPECT_EQ(DecodingError("t,x,y\n0,1,2\n"),
            "it is no history trace: it does not begin with MTHISTRY");
  EXPECT_EQ(DecodingError(With(bytes, 0, 'm')),
            "it is no history trace: it does not begin with MTHISTRY");
  EXPECT_EQ(DecodingError(With(bytes, kVersionAt, std::uint32_t{2})),
            "it has version 2 of the trace format: expected version 1");
  // A header of another version may be shorter.
  EXPECT_EQ(
      DecodingError(With(bytes, kVersionAt, std::uint32_t{7}).substr(0, 12)),
      "it has version 7 of the trace format: expected version 1");
}

TEST(DecodeTrace, DamageIsOneSentence) {
  const std::string bytes = EncodeTrace(ExampleTrace());
  EXPECT_EQ(DecodingError(With(bytes, kRecordSizeAt, std::uint32_t{32})),
            "it is damaged: records of 32 bytes, expected 24");
  EXPECT_EQ(DecodingError(bytes + "x"),
            "it is damaged: 241 bytes, expected 240");
  EXPECT_EQ(DecodingError(With(bytes, kNumBuffersAt, std::uint32_t{4})),
            "it is damaged: a buffer begins after its end");
  EXPECT_EQ(DecodingError(With(bytes, kNumBuffersAt, ~std::uint32_t{0})),
            "it is damaged: a buffer begins after its end");
  EXPECT_EQ(DecodingError(With(bytes, kNumBuffersAt, std::uint32_t{2})),
            "it is damaged: 56 bytes after the last buffer");
  for (const std::uint64_t records :
       {std::uint64_t{6}, std::uint64_t{1} << 61, ~std::uint64_t{0}}) {
    EXPECT_EQ(DecodingError(With(bytes, kNumRecordsAt, records)),
              "it is damaged: a buffer of " + std::to_string(records) +
                  " records does not fit into it");
  }
}

TEST(DecodeTrace, ClockMustTick) {
  const std::string bytes = EncodeTrace(ExampleTrace());
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double ticks : {0.0, -1.0, 1e-300, 1e15, infinity,
                             std::numeric_limits<double>::quiet_NaN()}) {
    const std::string error = DecodingError(With(bytes, kTicksAt, ticks));
    EXPECT_EQ(error.find("it is damaged: a clock of "), 0u) << error;
    EXPECT_NE(error.find(" ticks per second"), std::string::npos) << error;
  }
}

TEST(DecodeTrace, AnyChangedByteIsReadOrRejected) {
  const std::string bytes = EncodeTrace(ExampleTrace());
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    for (const char c : {'\0', '\1', '\x7f', '\xff'}) {
      const std::string error = DecodingError(With(bytes, i, c));
      EXPECT_EQ(error.find('\n'), std::string::npos);
    }
  }
}

TEST(Trace, SecondsBeforeRecordingAreNegative) {
  const Trace trace = ExampleTrace();
  EXPECT_EQ(trace.Seconds(1'000), 0);
  EXPECT_EQ(trace.Seconds(3'500), 1e-6);
  EXPECT_EQ(trace.Seconds(500), -2e-7);
}

class TraceFile : public testing::Test {
 protected:
  TraceFile()
      : folder_(fs::path(testing::TempDir()) /
                ("trace_file_test" + std::to_string(getpid()))) {
    fs::create_directories(folder_);
  }
  ~TraceFile() override { fs::remove_all(folder_); }

  std::string Path(const std::string& name) const { return folder_ / name; }
  std::set<std::string> Files() const {
    std::set<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder_)) {
      names.insert(entry.path().filename());
    }
    return names;
  }

  fs::path folder_;
};

TEST_F(TraceFile, IsReadAsItWasWritten) {
  WriteTrace(ExampleTrace(), Path("a"));
  EXPECT_EQ(ReadTrace(Path("a")), ExampleTrace());
  WriteTrace(Trace(), Path("a"));
  EXPECT_EQ(ReadTrace(Path("a")), Trace());
  EXPECT_EQ(Files(), std::set<std::string>{"a"});
}

TEST_F(TraceFile, LargerThanAnyPieceOfItIsReadWhole) {
  Trace trace = ExampleTrace();
  const TraceRecord record = {2'000, 3, 1, 0, TraceAction::kBarrierSync};
  trace.buffers[1].records.assign(100'000, record);
  WriteTrace(trace, Path("a"));
  EXPECT_EQ(ReadTrace(Path("a")), trace);
}

TEST_F(TraceFile, HasTheRightsThatTheUmaskLeaves) {
  const mode_t old = umask(027);
  WriteTrace(ExampleTrace(), Path("a"));
  EXPECT_EQ(umask(old), mode_t{027});
  EXPECT_EQ(fs::status(Path("a")).permissions(), fs::perms{0640});
}

TEST_F(TraceFile, UnwritablePathIsNamedWithTheReasonAndLeavesNothing) {
  const auto write = [](const std::string& path) {
    return MessageOf([&] { WriteTrace(ExampleTrace(), path); });
  };
  EXPECT_EQ(write(Path("none/a")),
            "cannot write '" + Path("none/a") + "': No such file or directory");
  fs::create_directories(Path("folder"));
  EXPECT_EQ(write(Path("folder")),
            "cannot write '" + Path("folder") + "': Is a directory");
  EXPECT_EQ(write(""), "cannot write '': No such file or directory");
  EXPECT_EQ(write("/dev/full"),
            "cannot write '/dev/full': No space left on device");
  EXPECT_EQ(Files(), std::set<std::string>{"folder"});
}

TEST_F(TraceFile, DeviceIsWrittenToAndNotReplaced) {
  WriteTrace(ExampleTrace(), "/dev/null");
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

TEST_F(TraceFile, OldFileStaysWhereTheNewOneCannotBeWritten) {
  // A name that is as long as the system allows has no room for another
  // beside it.
  const std::string path = Path(std::string(250, 'a'));
  std::ofstream(path) << "old";
  EXPECT_EQ(MessageOf([&] { WriteTrace(ExampleTrace(), path); }),
            "cannot write '" + path + "': File name too long");
  std::ifstream file(path);
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(file), {}), "old");
}

TEST_F(TraceFile, UnreadablePathIsNamedWithTheReason) {
  const auto read = [](const std::string& path) {
    return MessageOf([&] { ReadTrace(path); });
  };
  EXPECT_EQ(read(Path("a")),
            "cannot read '" + Path("a") + "': No such file or directory");
  EXPECT_EQ(read(folder_),
            "cannot read '" + folder_.string() + "': Is a directory");
  EXPECT_EQ(read("/dev/null"),
            "'/dev/null' is no history trace: it does not begin with MTHISTRY");
  std::ofstream(Path("b")) << "MTHISTRY";
  EXPECT_EQ(read(Path("b")), "'" + Path("b") +
                                 "' is truncated: 8 bytes, less than the "
                                 "header's 72");
}

TEST(TraceAction, NamesAreParsedBackAndDifferentFromEachOther) {
  std::set<std::string_view> names;
  for (int number = 1; number < kFirstUserAction; ++number) {
    const auto action = static_cast<TraceAction>(number);
    if (Name(action).empty()) continue;
    EXPECT_TRUE(names.insert(Name(action)).second) << Name(action);
    EXPECT_EQ(ParseTraceAction(Name(action)), action);
    EXPECT_FALSE(Name(ClassOf(action)).empty()) << Name(action);
  }
  EXPECT_EQ(names.size(), 29u);
  EXPECT_EQ(ParseTraceAction("BARSINK"), std::nullopt);
  EXPECT_EQ(ParseTraceAction(""), std::nullopt);
}

TEST(TraceAction, ClassesAreThoseOfBuftune) {
  EXPECT_EQ(ClassOf(TraceAction::kTaskWait), TraceClass::kTasks);
  EXPECT_EQ(ClassOf(TraceAction::kLockTestSet), TraceClass::kLocks);
  EXPECT_EQ(ClassOf(TraceAction::kBarrierSync), TraceClass::kEvents);
  EXPECT_EQ(ClassOf(TraceAction::kWake), TraceClass::kCpus);
  EXPECT_EQ(ClassOf(TraceAction::kTune), TraceClass::kInfo);
  for (const int number : {kFirstUserAction, kLastUserAction}) {
    EXPECT_EQ(ClassOf(static_cast<TraceAction>(number)), TraceClass::kUsers);
  }
  for (const char* name :
       {"TASKS", "LOCKS", "EVENTS", "CPUS", "USERS", "INFO"}) {
    ASSERT_TRUE(ParseTraceClass(name)) << name;
    EXPECT_EQ(Name(*ParseTraceClass(name)), name);
  }
  EXPECT_EQ(ParseTraceClass("BARRIERS"), std::nullopt);
}

TEST(TraceAction, WaitsHaveEnds) {
  EXPECT_EQ(EndOf(TraceAction::kTaskWait), TraceAction::kTaskWaitEnd);
  EXPECT_EQ(EndOf(TraceAction::kLockOn), TraceAction::kLockOnEnd);
  EXPECT_EQ(EndOf(TraceAction::kEventWait), TraceAction::kEventWaitEnd);
  EXPECT_EQ(EndOf(TraceAction::kBarrierSync), TraceAction::kBarrierSyncEnd);
  EXPECT_EQ(EndOf(TraceAction::kEventPost), TraceAction::kNone);
}

}  // namespace
}  // namespace macrotask
