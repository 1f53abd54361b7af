#include <gtest/gtest.h>

#include <initializer_list>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/bench/predict/minimal_machine.h"

namespace bench::predict {
namespace {

using Json = nlohmann::ordered_json;

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
      {"/lanes/1/OCDS", "{}",
       "an unknown member at lanes.1.OCDS: expected one of start, CS, OCD, "
       "RMA, CCD, shift, other"},
      {"/lanes/1/OCD", R"({"calls": 1})",
       "an unknown member at lanes.1.OCD.calls: expected one of call, pack, "
       "item, spread"},
      {"/slowdowns", R"([{"because": ""}])",
       "an unknown member at slowdowns[0].because: expected one of "
       "from_processors, lanes, factor, why"},
      {"/conditions/0/lines", a,
       "an unknown member at conditions[0].lines: expected one of name, share, "
       "point_line, tip_line, waits"},
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
      {"/conditions/0/point_line", "-1e-9",
       "-1e-09 at conditions[0].point_line: expected a time in seconds, 0 or "
       "more"},
      {"/conditions/0/tip_line", "-1",
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
      {"/slowdowns",
       R"([{"lanes": 1}, {"from_processors": 4, "lanes": 4}, {"lanes": 1}])",
       "nothing at slowdowns[2].from_processors: expected more processors than "
       "in the slowdown before"},
  });
}

TEST(ParseMachine, RefusesSlowdownsOfLanesThatAreNone) {
  ExpectErrors({
      {"/slowdowns", R"([{"lanes": 2}])",
       "2 at slowdowns[0].lanes: expected 0, 1 or 4"},
      {"/slowdowns", R"([{"lanes": 1}, {"lanes": -1}])",
       "-1 at slowdowns[1].lanes: expected 0, 1 or 4"},
      {"/slowdowns", R"([{"lanes": 1.5}])",
       "1.5 at slowdowns[0].lanes: expected 0, 1 or 4"},
      {"/slowdowns", R"([{"lanes": "4"}])",
       "\"4\" at slowdowns[0].lanes: expected 0, 1 or 4"},
      {"/slowdowns", R"([{"lanes": null}])",
       "null at slowdowns[0].lanes: expected 0, 1 or 4"},
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
            "m.json has a number beyond all doubles at "
            "conditions[2].tip_line[1]: expected a finite one");
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

}  // namespace
}  // namespace bench::predict
