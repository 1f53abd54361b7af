#include "bench/predict/machine_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <random>
#include <stdexcept>
#include <string>

#include "macrotask/whole_file.h"

namespace bench::predict {
namespace {

using Json = nlohmann::ordered_json;
using macrotask::WaitKind;
using Limits = std::numeric_limits<double>;

constexpr const char* kMinimal =
    R"({"format": "macrotask machine 1", "name": "m", "processors": 2,)"
    R"( "lanes": {"1": {}}, "conditions": [{"waits": {"hold": {}}}]})";

// Has every member, most of them figures that no decimal of few digits gives.
MachineModel FullMachine() {
  MachineModel machine;
  machine.name = "CRAY \"Y-MP\"\n8/864";
  machine.source = "Zürich, \\1";
  machine.processors = 8;
  double figure = 1e-7 / 3;
  const auto next = [&] { return figure *= 1.1; };
  for (const int width : {1, 4}) {
    for (int block = 0; block < kNumBlocks - 1; ++block) {
      machine.lanes[width][static_cast<std::size_t>(block)] = {
          next(), next(), next(), {1 / 3.0, std::nextafter(1.0, 2.0), 2e5 / 3}};
    }
  }
  for (const char* name : {"near", "far"}) {
    Condition condition = {name, 0.5, next(), {}};
    for (const WaitKind kind : {WaitKind::kBlock, WaitKind::kSpin,
                                WaitKind::kHold, WaitKind::kLogical}) {
      condition.waits[kind] = {{next(), next(), next(), next()},
                               next(),
                               next(),
                               next(),
                               next(),
                               next(),
                               next(),
                               next(),
                               next(),
                               next()};
    }
    machine.conditions.push_back(condition);
  }
  machine.slowdowns = {{2, 1 + next(), "clock"}, {8, 1.07, "memory"}};
  return machine;
}

MachineModel MinimalMachine() {
  MachineModel machine;
  machine.name = "m";
  machine.processors = 2;
  machine.lanes[1] = {};
  machine.conditions.resize(1);
  machine.conditions[0].waits[WaitKind::kHold] = {};
  return machine;
}

std::string ErrorOf(std::string_view text) {
  try {
    ParseMachine(text, "m.json");
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

TEST(MachineText, ComesBackAsTheMachineItWas) {
  for (const MachineModel& machine : {FullMachine(), MinimalMachine()}) {
    const std::string text = MachineText(machine);
    const MachineModel back = ParseMachine(text, "text");
    EXPECT_EQ(back, machine) << text;
    EXPECT_EQ(MachineText(back), text);
  }
}

// All doubles between the least and the largest, as likely as their bits.
TEST(MachineText, KeepsEveryBitOfAFigure) {
  MachineModel machine = MinimalMachine();
  Spread& spread = machine.lanes[1][0].spread;
  spread = {Limits::denorm_min(), Limits::min(), Limits::max()};
  std::mt19937_64 bits(1);
  while (spread.size() < 10000) {
    const double figure = std::abs(std::bit_cast<double>(bits()));
    if (std::isfinite(figure) && figure > 0) spread.push_back(figure);
  }
  std::sort(spread.begin(), spread.end());
  EXPECT_EQ(ParseMachine(MachineText(machine), "text"), machine);
}

TEST(MachineText, KeepsTheSignOfNothing) {
  MachineModel machine = MinimalMachine();
  machine.conditions[0].point_line = -0.0;
  const MachineModel back = ParseMachine(MachineText(machine), "text");
  EXPECT_TRUE(std::signbit(back.conditions[0].tip_line));
}

TEST(MachineText, LeavesOutWhatThereIsNot) {
  const std::string text = MachineText(MinimalMachine());
  for (const char* name : {"sleeps_after", "round", "level", "spread"}) {
    EXPECT_EQ(text.find(name), std::string::npos) << name;
  }
}

TEST(MachineText, KeepsTheFiguresOfABlockOnOneLine) {
  MachineModel machine = MinimalMachine();
  machine.lanes[1][0] = {1, 0.5, 0.25, {0.5, 1, 2}};
  const std::string line =
      "\n      \"start\": {\"call\": 1.0, \"pack\": 0.5, \"item\": 0.25, "
      "\"spread\": [0.5, 1.0, 2.0]},\n";
  const std::string text = MachineText(machine);
  EXPECT_NE(text.find(line), std::string::npos) << text;
}

TEST(MachineText, ReplacesBytesThatAreNoUtf8) {
  MachineModel machine = MinimalMachine();
  machine.name = "a\xff";
  EXPECT_EQ(ParseMachine(MachineText(machine), "text").name, "a\uFFFD");
}

// As the example of the header.
constexpr const char* kExample = R"({
    "format": "macrotask machine 1",
    "name": "CRAY Y-MP8/864, UNICOS 6.0",
    "source": "where the figures come from",
    "processors": 8,
    "lanes": {
      "1": {
        "OCD": {"call": 0, "pack": 2e-4, "item": 1e-4,
                "spread": [0.99, 1, 1.01]},
        "shift": {"call": 3e-6}
      }
    },
    "slowdowns": [{"from_processors": 8, "factor": 1.07, "why": "shared"}],
    "conditions": [
      {
        "name": "near", "share": 1, "point_line": 4e-8,
        "waits": {
          "hold": {
            "barrier": {"two": 1e-7, "further": 5e-8, "round": 2e-7,
                        "level": 3e-7},
            "event": 4e-7, "post": 5e-7, "lock": 6e-7, "start": 7e-7,
            "sleeps_after": 5e-5, "wake": 2e-5, "waker": 5e-6,
            "turn": 2e-6, "shared_wake": 1e-5
          }
        }
      }
    ]
  })";

TEST(ParseMachine, ReadsEveryMember) {
  MachineModel expected;
  expected.name = "CRAY Y-MP8/864, UNICOS 6.0";
  expected.source = "where the figures come from";
  expected.processors = 8;
  BlockCosts& blocks = expected.lanes[1];
  blocks[static_cast<std::size_t>(Block::kOcd)] = {
      0, 2e-4, 1e-4, {0.99, 1, 1.01}};
  blocks[static_cast<std::size_t>(Block::kShift)] = {.call = 3e-6};
  expected.slowdowns = {{8, 1.07, "shared"}};
  expected.conditions = {{"near", 1, 4e-8, {}}};
  expected.conditions[0].waits[WaitKind::kHold] = {
      .barrier = {1e-7, 5e-8, 2e-7, 3e-7},
      .event = 4e-7,
      .post = 5e-7,
      .lock = 6e-7,
      .start = 7e-7,
      .sleeps_after = 5e-5,
      .wake = 2e-5,
      .waker = 5e-6,
      .turn = 2e-6,
      .shared_wake = 1e-5};
  EXPECT_EQ(ParseMachine(kExample, "text"), expected);
}

TEST(ParseMachine, TakesWhatIsNotThereAsMachineHHasIt) {
  const MachineModel machine = ParseMachine(kMinimal, "text");
  EXPECT_EQ(machine, MinimalMachine());
  EXPECT_EQ(machine.conditions[0].share, 1);
  const WaitCost& cost = machine.conditions[0].waits.at(WaitKind::kHold);
  EXPECT_EQ(cost.sleeps_after, kNever);
  EXPECT_EQ(cost.barrier.round, std::nullopt);
  EXPECT_EQ(cost.barrier.level, std::nullopt);
}

TEST(ParseMachine, TakesAWholeNumberThatIsWrittenWithAPoint) {
  Json json = Json::parse(kMinimal);
  json["processors"] = 2.0;
  EXPECT_EQ(ParseMachine(json.dump(), "text"), MinimalMachine());
}

TEST(ParseMachine, TakesSharesThatAddUpToOneInPrint) {
  Json json = Json::parse(kMinimal);
  Json& conditions = json["conditions"];
  conditions = {conditions[0], conditions[0], conditions[0]};
  for (std::size_t i = 0; i < 3; ++i) {
    conditions[i]["name"] = std::to_string(i);
    conditions[i]["share"] = 0.3333333;
  }
  EXPECT_EQ(ErrorOf(json.dump()), "");
}

// What becomes of the minimal machine where `path` has `value`, or is removed.
struct BadMember {
  const char* path;
  const char* value;
  const char* error;
};

std::string TextWith(const BadMember& bad) {
  Json step = {{"op", bad.value == nullptr ? "remove" : "add"},
               {"path", bad.path}};
  if (bad.value != nullptr) step["value"] = Json::parse(bad.value);
  return Json::parse(kMinimal).patch(Json::array({step})).dump();
}

void ExpectErrors(std::initializer_list<BadMember> table) {
  for (const BadMember& bad : table) {
    const std::string text = TextWith(bad);
    EXPECT_EQ(ErrorOf(text), std::string("m.json has ") + bad.error) << text;
  }
}

TEST(ParseMachine, RefusesMembersThatNobodyKnows) {
  const char* a = "1";
  ExpectErrors({
      {"/cpus", a,
       "an unknown member at cpus: expected one of format, name, source, "
       "processors, lanes, slowdowns, conditions"},
      {"/a\\n b", a,
       "an unknown member at a\\\\n b: expected one of format, name, source, "
       "processors, lanes, slowdowns, conditions"},
      {"/lanes/2", "{}", "an unknown member at lanes.2: expected one of 1, 4"},
      {"/lanes/1/other", "{}",
       "an unknown member at lanes.1.other: expected one of start, CS, OCD, "
       "RMA, CCD, shift"},
      {"/lanes/1/OCD", R"({"calls": 1})",
       "an unknown member at lanes.1.OCD.calls: expected one of call, pack, "
       "item, spread"},
      {"/slowdowns", R"([{"because": ""}])",
       "an unknown member at slowdowns[0].because: expected one of "
       "from_processors, factor, why"},
      {"/conditions/0/lines", a,
       "an unknown member at conditions[0].tip_lines: expected one of name, share, "
       "line, waits"},
      {"/conditions/0/waits/auto", "{}",
       "an unknown member at conditions[0].waits.auto: expected one of block, "
       "spin, hold, logical"},
      {"/conditions/0/waits/hold/events", a,
       "an unknown member at conditions[0].waits.hold.events: expected one of "
       "event, post, lock, start, sleeps_after, wake, waker, turn, "
       "shared_wake, barrier"},
      {"/conditions/0/waits/hold/barrier", R"({"three": 1})",
       "an unknown member at conditions[0].waits.hold.barrier.three: expected "
       "one of two, further, round, level"},
  });
}

TEST(ParseMachine, RefusesToGoWithoutWhatMustBeThere) {
  ExpectErrors({
      {"/format", nullptr,
       "nothing at format: expected \"macrotask machine 1\""},
      {"/name", nullptr, "nothing at name: expected a text"},
      {"/processors", nullptr,
       "nothing at processors: expected a whole number, 1 to 2147483647"},
      {"/lanes", nullptr, "nothing at lanes: expected an object"},
      {"/conditions", nullptr,
       "nothing at conditions: expected an array of at least one condition"},
      {"/conditions", "[]",
       "an empty array at conditions: expected an array of at least one "
       "condition"},
      {"/conditions/0/waits", nullptr,
       "nothing at conditions[0].waits: expected an object of at least one way "
       "to wait"},
      {"/conditions/0/waits", "{}",
       "an empty object at conditions[0].waits: expected an object of at least "
       "one way to wait"},
  });
}

TEST(ParseMachine, RefusesTimesThatAreNone) {
  ExpectErrors({
      {"/lanes/1/CS", R"({"item": -1e-9})",
       "-1e-09 at lanes.1.CS.item: expected a time in seconds, 0 or more"},
      {"/lanes/1/CS", R"({"call": "1"})",
       "\"1\" at lanes.1.CS.call: expected a time in seconds, 0 or more"},
      {"/conditions/0/line", "-1",
       "-1 at conditions[0].tip_line: expected a time in seconds, 0 or more"},
      {"/conditions/0/waits/hold/sleeps_after", "null",
       "null at conditions[0].waits.hold.sleeps_after: expected a time in "
       "seconds, 0 or more"},
      {"/conditions/0/waits/hold/barrier", R"({"two": -1})",
       "-1 at conditions[0].waits.hold.barrier.two: expected a time in "
       "seconds, 0 or more"},
      {"/conditions/0/waits/hold/barrier", R"({"level": true})",
       "true at conditions[0].waits.hold.barrier.level: expected a time in "
       "seconds, 0 or more"},
  });
}

TEST(ParseMachine, RefusesFiguresThatNoMachineHas) {
  ExpectErrors({
      {"/processors", "0",
       "0 at processors: expected a whole number, 1 to 2147483647"},
      {"/processors", "2.5",
       "2.5 at processors: expected a whole number, 1 to 2147483647"},
      {"/processors", "2147483648",
       "2147483648 at processors: expected a whole number, 1 to 2147483647"},
      {"/lanes/1/RMA", R"({"spread": [0.9, 1.1, 1]})",
       "1 at lanes.1.RMA.spread[2]: expected a ratio above 0 and not below the "
       "one before"},
      {"/lanes/1/RMA", R"({"spread": [0, 1]})",
       "0 at lanes.1.RMA.spread[0]: expected a ratio above 0 and not below the "
       "one before"},
      {"/conditions/0/share", "-1",
       "-1 at conditions[0].share: expected a share, 0 to 1"},
      {"/conditions/0/share", "0.99999",
       "shares that add up to 0.99999 at conditions: expected 1"},
      {"/conditions/0/share", "2",
       "shares that add up to 2 at conditions: expected 1"},
  });
}

TEST(ParseMachine, RefusesSlowdownsThatAreNone) {
  ExpectErrors({
      {"/slowdowns", R"([{"factor": 0.5}])",
       "0.5 at slowdowns[0].factor: expected a factor of 1 or more"},
      {"/slowdowns", R"([{"from_processors": 0}])",
       "0 at slowdowns[0].from_processors: expected a whole number, 1 to "
       "2147483647"},
      {"/slowdowns", R"([{"from_processors": 8}, {"from_processors": 8}])",
       "8 at slowdowns[1].from_processors: expected more processors than in "
       "the slowdown before"},
      {"/slowdowns", R"([{"from_processors": 8}, {"factor": 2}])",
       "nothing at slowdowns[1].from_processors: expected more processors than "
       "in the slowdown before"},
  });
}

TEST(ParseMachine, RefusesTwoConditionsOfOneName) {
  ExpectErrors({
      {"/conditions", R"([{"name": "near", "share": 0.5, "waits": {"hold": {}}},
                          {"name": "near", "share": 0.5, "waits": {"hold": {}}}
                         ])",
       "\"near\" at conditions[1].name: expected a name that no condition "
       "before has"},
      {"/conditions/-", R"({"waits": {"hold": {}}})",
       "nothing at conditions[1].name: expected a name that no condition "
       "before has"},
  });
}

TEST(ParseMachine, RefusesValuesOfAnotherKind) {
  ExpectErrors({
      {"", "[1]", "an array at its top: expected an object"},
      {"/format", "\"macrotask machine 2\"",
       "\"macrotask machine 2\" at format: expected \"macrotask machine 1\""},
      {"/format", "1", "1 at format: expected a text"},
      {"/name", "{\"a\": 1}", "an object at name: expected a text"},
      {"/source", "null", "null at source: expected a text"},
      {"/lanes", "[1]", "an array at lanes: expected an object"},
      {"/lanes/1/OCD", "1e-4", "0.0001 at lanes.1.OCD: expected an object"},
      {"/lanes/1/OCD", R"({"spread": 1})",
       "1 at lanes.1.OCD.spread: expected an array"},
      {"/slowdowns", "1.07", "1.07 at slowdowns: expected an array"},
      {"/conditions", R"({"near": 1})",
       "an object at conditions: expected an array"},
      {"/conditions/0", "null", "null at conditions[0]: expected an object"},
      {"/conditions/0/waits", "[\"hold\"]",
       "an array at conditions[0].waits: expected an object"},
      {"/conditions/0/waits/hold", "1",
       "1 at conditions[0].waits.hold: expected an object"},
  });
}

TEST(ParseMachine, SaysOfAnotherFormatFirstThatItIsOne) {
  EXPECT_EQ(ErrorOf(R"({"format": "macrotask machine 2", "news": 1})"),
            "m.json has \"macrotask machine 2\" at format: expected "
            "\"macrotask machine 1\"");
}

TEST(ParseMachine, RefusesAMemberThatIsThereTwice) {
  EXPECT_EQ(ErrorOf(R"({"lanes": {"1": {}, "4": {"CS": {}, "CS": {}}}})"),
            "m.json has a second member at lanes.4.CS: expected one of a name");
  EXPECT_EQ(ErrorOf(R"({"a": [{"b": 1}, {"b": 1}, {"c": [], "c": []}]})"),
            "m.json has a second member at a[2].c: expected one of a name");
}

TEST(ParseMachine, RefusesNumbersBeyondAllDoubles) {
  EXPECT_EQ(ErrorOf(R"({"processors": 1e999})"),
            "m.json has a number beyond all doubles at processors: expected a "
            "finite one");
  EXPECT_EQ(ErrorOf(R"({"conditions": [{}, [], {"tip_line": [0, -1e999]}]})"),
            "m.json has a number beyond all doubles at conditions[2].tip_line[1]: "
            "expected a finite one");
}

TEST(ParseMachine, SaysWhereATextIsNoJson) {
  const struct {
    const char* text;
    const char* error;
  } kTable[] = {
      {"",
       "1, column 1: unexpected end of input; expected '[', '{', or a literal"},
      {"{\n  \"line\": NaN\n}",
       "2, column 11: invalid literal; last read: '\"line\": N'"},
      {"{\n  \"line\": Infinity\n}",
       "2, column 11: invalid literal; last read: '\"line\": I'"},
      {"{\"a\": 1,}", "1, column 9: unexpected '}'; expected string literal"},
      {"{} {}", "1, column 4: unexpected '{'; expected end of input"},
      {"{\n\"a\": [1\n", "3, column 1: unexpected end of input; expected ']'"},
      {"\x7f"
       "ELF",
       "1, column 1: invalid literal; last read: '\x7f'"},
  };
  for (const auto& [text, error] : kTable) {
    EXPECT_EQ(ErrorOf(text), std::string("m.json is no JSON at line ") + error)
        << text;
  }
}

class ReadMachineTest : public testing::Test {
 protected:
  ~ReadMachineTest() override { std::filesystem::remove(path_); }

  std::string ErrorOfReading(const std::string& path) {
    try {
      ReadMachine(path);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  }

  const std::string path_ = testing::TempDir() + "machine_file_test" +
                            std::to_string(getpid()) + ".json";
};

TEST_F(ReadMachineTest, ReadsWhatWasWritten) {
  macrotask::WriteWholeFile(path_, MachineText(FullMachine()));
  EXPECT_EQ(ReadMachine(path_), FullMachine());
}

TEST_F(ReadMachineTest, NamesTheFileThatIsNoMachine) {
  macrotask::WriteWholeFile(path_, "[]");
  EXPECT_EQ(ErrorOfReading(path_), "'" + path_ +
                                       "' has an empty array at its top: "
                                       "expected an object");
}

TEST_F(ReadMachineTest, NamesTheFileThatCannotBeReadWithTheReason) {
  EXPECT_EQ(ErrorOfReading(path_),
            "cannot read '" + path_ + "': No such file or directory");
  EXPECT_EQ(ErrorOfReading("/tmp"), "cannot read '/tmp': Is a directory");
}

}  // namespace
}  // namespace bench::predict
