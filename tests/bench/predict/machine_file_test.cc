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
#include "tests/bench/predict/minimal_machine.h"

namespace bench::predict {
namespace {

using Json = nlohmann::ordered_json;
using macrotask::WaitKind;
using Limits = std::numeric_limits<double>;

// Has every member, most of them figures that no decimal of few digits gives.
MachineModel FullMachine() {
  MachineModel machine;
  machine.name = "CRAY \"Y-MP\"\n8/864";
  machine.source = "Zürich, \\1";
  machine.processors = 8;
  double figure = 1e-7 / 3;
  const auto next = [&] { return figure *= 1.1; };
  for (const int width : {1, 4}) {
    for (int block = 0; block < kNumBlocks; ++block) {
      machine.lanes[width][static_cast<std::size_t>(block)] = {
          next(), next(), next(), {1 / 3.0, std::nextafter(1.0, 2.0), 2e5 / 3}};
    }
  }
  for (const char* name : {"near", "far"}) {
    Condition condition = {name, 0.5, next(), next(), {}};
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
  machine.slowdowns = {{2, 0, 1 + next(), "clock"},
                       {8, 0, 1.07, "memory"},
                       {2, 4, 1 + next(), "vectors"}};
  return machine;
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
  machine.conditions[0].tip_line = -0.0;
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
        "shift": {"call": 3e-6},
        "other": {"spread": [0.5, 1, 2]}
      }
    },
    "slowdowns": [{"from_processors": 8, "lanes": 1, "factor": 1.07,
                   "why": "shared"}],
    "conditions": [
      {
        "name": "near", "share": 1, "point_line": 4e-8, "tip_line": 9e-9,
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
  blocks[static_cast<std::size_t>(Block::kOther)] = {.spread = {0.5, 1, 2}};
  expected.slowdowns = {{8, 1, 1.07, "shared"}};
  expected.conditions = {{"near", 1, 4e-8, 9e-9, {}}};
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

TEST(ParseMachine, TakesSlowdownsInAscendingOrderOfEachWidth) {
  Json json = Json::parse(kMinimal);
  json["slowdowns"] =
      Json::parse(R"([{"from_processors": 8, "lanes": 4, "factor": 2},
                      {"from_processors": 2, "lanes": 1},
                      {"from_processors": 8, "lanes": 0, "why": "memory"},
                      {"from_processors": 9, "lanes": 1, "factor": 1.5}])");
  const std::vector<Slowdown> expected = {
      {8, 4, 2, ""}, {2, 1, 1, ""}, {8, 0, 1, "memory"}, {9, 1, 1.5, ""}};
  EXPECT_EQ(ParseMachine(json.dump(), "text").slowdowns, expected);
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
