#include "bench/predict/machine_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <limits>
#include <nlohmann/json.hpp>
#include <span>
#include <stdexcept>
#include <utility>

#include "macrotask/whole_file.h"

namespace bench::predict {
namespace {

using Json = nlohmann::ordered_json;
using macrotask::WaitKind;

constexpr std::string_view kFormat = "macrotask machine 1";
constexpr WaitKind kWaitKinds[] = {WaitKind::kBlock, WaitKind::kSpin,
                                   WaitKind::kHold, WaitKind::kLogical};
constexpr Block kBlocks[] = {Block::kStart, Block::kCs,    Block::kOcd,
                             Block::kRma,   Block::kCcd,   Block::kShift,
                             Block::kOther};

template <typename Cost>
struct TimeMember {
  std::string_view name;
  double Cost::*time;
};
constexpr TimeMember<BlockCost> kBlockTimes[] = {{"call", &BlockCost::call},
                                                 {"pack", &BlockCost::pack},
                                                 {"item", &BlockCost::item}};
constexpr TimeMember<BarrierCost> kBarrierTimes[] = {
    {"two", &BarrierCost::two}, {"further", &BarrierCost::further}};
constexpr TimeMember<WaitCost> kWaitTimes[] = {
    {"event", &WaitCost::event},
    {"post", &WaitCost::post},
    {"lock", &WaitCost::lock},
    {"start", &WaitCost::start},
    {"sleeps_after", &WaitCost::sleeps_after},
    {"wake", &WaitCost::wake},
    {"waker", &WaitCost::waker},
    {"turn", &WaitCost::turn},
    {"shared_wake", &WaitCost::shared_wake}};

// Shares may be written by hand: 0.3333333 for a third.
constexpr double kShareTolerance = 1e-6;

[[noreturn]] void Fail(std::string_view file, std::string_view found,
                       std::string_view path, std::string_view expected) {
  throw std::runtime_error(fmt::format("{} has {} at {}: expected {}", file,
                                       found, path.empty() ? "its top" : path,
                                       expected));
}

// Escaped: a key may be of several lines.
std::string MemberPath(const std::string& path, std::string_view key) {
  const std::string quoted = Json(key).dump();
  return path + (path.empty() ? "" : ".") + quoted.substr(1, quoted.size() - 2);
}

std::string ElementPath(const std::string& path, std::size_t index) {
  return fmt::format("{}[{}]", path, index);
}

// The value that the parser is reading.
class Place {
 public:
  // Returns false at a member that the object has already.
  bool Follow(Json::parse_event_t event, const Json& json) {
    using Event = Json::parse_event_t;
    if (event == Event::key) return AddKey(json.get<std::string>());
    if (event == Event::object_start || event == Event::array_start) {
      levels_.push_back({.is_array = event == Event::array_start});
      return true;
    }
    if (event != Event::value) levels_.pop_back();
    if (!levels_.empty()) ++levels_.back().num_values;
    return true;
  }

  std::string Path() const {
    std::string path;
    for (const Level& level : levels_) {
      path = level.is_array ? ElementPath(path, level.num_values)
                            : MemberPath(path, level.keys.back());
    }
    return path;
  }

 private:
  struct Level {
    bool is_array = false;
    std::size_t num_values = 0;          // that are complete
    std::vector<std::string> keys = {};  // of an object, the last one's value
                                         // may still be to come
  };

  bool AddKey(std::string key) {
    std::vector<std::string>& keys = levels_.back().keys;
    const bool is_new = std::find(keys.begin(), keys.end(), key) == keys.end();
    keys.push_back(std::move(key));
    return is_new;
  }

  std::vector<Level> levels_;
};

[[noreturn]] void FailSyntax(const Json::parse_error& error,
                             std::string_view text, std::string_view file) {
  const std::string_view read = text.substr(
      0, std::min(text.size(), std::max(error.byte, std::size_t{1}) - 1));
  const auto line = 1 + std::count(read.begin(), read.end(), '\n');
  const auto column = read.size() - (read.rfind('\n') + 1) + 1;
  // The library's own text is "[id] parse error at ...: syntax error while
  // parsing ... - reason".
  const std::string_view what = error.what();
  const std::size_t dash = what.find(" - ");
  throw std::runtime_error(
      fmt::format("{} is no JSON at line {}, column {}: {}", file, line, column,
                  dash == what.npos ? "syntax error" : what.substr(dash + 3)));
}

// Unlike the library, takes no member twice.
Json ParseJson(std::string_view text, std::string_view file) {
  Place place;
  const auto follow = [&](int, Json::parse_event_t event, const Json& json) {
    if (!place.Follow(event, json)) {
      Fail(file, "a second member", place.Path(), "one of a name");
    }
    return true;
  };
  try {
    return Json::parse(text, follow);
  } catch (const Json::parse_error& error) {
    FailSyntax(error, text, file);
  } catch (const Json::out_of_range&) {
    Fail(file, "a number beyond all doubles", place.Path(), "a finite one");
  }
}

// A value of the file, and where it is. What belongs to a value that is missing
// is missing as well, so that everything that may be left out can be read.
class Value {
 public:
  Value(const Json* json, std::string_view file, std::string path)
      : json_(json), file_(file), path_(std::move(path)) {}

  bool is_missing() const { return json_ == nullptr; }
  bool is_empty() const { return json_ == nullptr || json_->empty(); }
  [[noreturn]] void Fail(std::string_view found,
                         std::string_view expected) const {
    predict::Fail(file_, found, path_, expected);
  }
  [[noreturn]] void Expect(std::string_view expected) const {
    Fail(Description(), expected);
  }

  void ExpectObject(const std::vector<std::string_view>& keys) const;
  Value operator[](std::string_view key) const;  // of an object
  std::vector<Value> Elements() const;

  double Number(double least, std::string_view expected) const {
    const bool is_right =
        !is_missing() && json_->is_number() && json_->get<double>() >= least;
    if (!is_right) Expect(expected);
    return json_->get<double>();
  }
  std::string Text() const {
    if (is_missing() || !json_->is_string()) Expect("a text");
    return json_->get<std::string>();
  }
  std::string TextOrNone() const { return is_missing() ? "" : Text(); }

 private:
  std::string Description() const {
    if (is_missing()) return "nothing";
    if (!json_->is_structured()) return json_->dump();
    return fmt::format("an {}{}", is_empty() ? "empty " : "",
                       json_->type_name());
  }

  const Json* json_;
  std::string_view file_;
  std::string path_;
};

void Value::ExpectObject(const std::vector<std::string_view>& keys) const {
  if (is_missing()) return;
  if (!json_->is_object()) Expect("an object");
  for (const auto& [key, unused] : json_->items()) {
    if (std::find(keys.begin(), keys.end(), key) == keys.end()) {
      predict::Fail(file_, "an unknown member", MemberPath(path_, key),
                    fmt::format("one of {}", fmt::join(keys, ", ")));
    }
  }
}

Value Value::operator[](std::string_view key) const {
  const Json* member = nullptr;
  if (!is_missing()) {
    const auto found = json_->find(key);
    if (found != json_->end()) member = &*found;
  }
  return {member, file_, MemberPath(path_, key)};
}

std::vector<Value> Value::Elements() const {
  std::vector<Value> elements;
  if (is_missing()) return elements;
  if (!json_->is_array()) Expect("an array");
  for (const Json& json : *json_) {
    elements.emplace_back(&json, file_, ElementPath(path_, elements.size()));
  }
  return elements;
}

std::optional<double> Time(const Value& value) {
  if (value.is_missing()) return std::nullopt;
  return value.Number(0, "a time in seconds, 0 or more");
}

int NumProcessors(const Value& value) {
  constexpr int kMost = std::numeric_limits<int>::max();
  const std::string expected = fmt::format("a whole number, 1 to {}", kMost);
  const double number = value.Number(1, expected);
  if (number > kMost || number != std::trunc(number)) value.Expect(expected);
  return static_cast<int>(number);
}

// An object of `members` and of `others`, which the caller reads.
template <typename Cost>
Cost ReadTimes(const Value& value, std::span<const TimeMember<Cost>> members,
               std::initializer_list<std::string_view> others) {
  std::vector<std::string_view> names;
  for (const auto& member : members) names.push_back(member.name);
  names.insert(names.end(), others);
  value.ExpectObject(names);
  Cost cost;
  for (const auto& [name, time] : members) {
    cost.*time = Time(value[name]).value_or(cost.*time);
  }
  return cost;
}

Spread ReadSpread(const Value& value) {
  Spread spread;
  for (const Value& ratio : value.Elements()) {
    spread.push_back(
        ratio.Number(spread.empty() ? std::numeric_limits<double>::denorm_min()
                                    : spread.back(),
                     "a ratio above 0 and not below the one before"));
  }
  return spread;
}

BlockCost ReadBlock(const Value& value) {
  auto cost = ReadTimes<BlockCost>(value, kBlockTimes, {"spread"});
  cost.spread = ReadSpread(value["spread"]);
  return cost;
}

BlockCosts ReadBlocks(const Value& value) {
  std::vector<std::string_view> names;
  for (const Block block : kBlocks) names.push_back(Name(block));
  value.ExpectObject(names);
  BlockCosts costs;
  for (const Block block : kBlocks) {
    costs[static_cast<std::size_t>(block)] = ReadBlock(value[Name(block)]);
  }
  return costs;
}

std::map<int, BlockCosts> ReadLanes(const Value& value) {
  if (value.is_missing()) value.Expect("an object");
  value.ExpectObject({"1", "4"});
  std::map<int, BlockCosts> lanes;
  for (const int width : {1, 4}) {
    const Value costs = value[std::to_string(width)];
    if (!costs.is_missing()) lanes[width] = ReadBlocks(costs);
  }
  return lanes;
}

BarrierCost ReadBarrier(const Value& value) {
  auto cost = ReadTimes<BarrierCost>(value, kBarrierTimes, {"round", "level"});
  cost.round = Time(value["round"]);
  cost.level = Time(value["level"]);
  return cost;
}

WaitCost ReadWait(const Value& value) {
  auto cost = ReadTimes<WaitCost>(value, kWaitTimes, {"barrier"});
  cost.barrier = ReadBarrier(value["barrier"]);
  return cost;
}

std::map<WaitKind, WaitCost> ReadWaits(const Value& value) {
  std::vector<std::string_view> names;
  for (const WaitKind kind : kWaitKinds) names.push_back(Name(kind));
  value.ExpectObject(names);
  if (value.is_empty()) value.Expect("an object of at least one way to wait");
  std::map<WaitKind, WaitCost> waits;
  for (const WaitKind kind : kWaitKinds) {
    const Value cost = value[Name(kind)];
    if (!cost.is_missing()) waits[kind] = ReadWait(cost);
  }
  return waits;
}

Condition ReadCondition(const Value& value) {
  value.ExpectObject({"name", "share", "point_line", "tip_line", "waits"});
  const Value share = value["share"];
  return {.name = value["name"].TextOrNone(),
          .share = share.is_missing() ? 1 : share.Number(0, "a share, 0 to 1"),
          .point_line = Time(value["point_line"]).value_or(0),
          .tip_line = Time(value["tip_line"]).value_or(0),
          .waits = ReadWaits(value["waits"])};
}

std::vector<Condition> ReadConditions(const Value& value) {
  if (value.is_empty()) value.Expect("an array of at least one condition");
  std::vector<Condition> conditions;
  double sum = 0;
  for (const Value& element : value.Elements()) {
    Condition condition = ReadCondition(element);
    for (const Condition& other : conditions) {
      if (other.name != condition.name) continue;
      element["name"].Expect("a name that no condition before has");
    }
    sum += condition.share;
    conditions.push_back(std::move(condition));
  }
  if (std::abs(sum - 1) > kShareTolerance) {
    value.Fail(fmt::format("shares that add up to {:.7g}", sum), "1");
  }
  return conditions;
}

Slowdown ReadSlowdown(const Value& value, const std::vector<Slowdown>& others) {
  value.ExpectObject({"from_processors", "lanes", "factor", "why"});
  const Value from = value["from_processors"], factor = value["factor"];
  const Value lanes = value["lanes"];
  Slowdown slowdown = {.why = value["why"].TextOrNone()};
  if (!from.is_missing()) slowdown.from_processors = NumProcessors(from);
  if (!lanes.is_missing()) {
    const double width = lanes.Number(0, "0, 1 or 4");
    if (width != 0 && width != 1 && width != 4) lanes.Expect("0, 1 or 4");
    slowdown.lanes = static_cast<int>(width);
  }
  for (const Slowdown& before : others) {
    if (before.lanes == slowdown.lanes &&
        slowdown.from_processors <= before.from_processors) {
      from.Expect("more processors than in the slowdown before");
    }
  }
  if (!factor.is_missing()) {
    slowdown.factor = factor.Number(1, "a factor of 1 or more");
  }
  return slowdown;
}

std::vector<Slowdown> ReadSlowdowns(const Value& value) {
  std::vector<Slowdown> slowdowns;
  for (const Value& element : value.Elements()) {
    slowdowns.push_back(ReadSlowdown(element, slowdowns));
  }
  return slowdowns;
}

// Appends to `json`, without times that are never.
template <typename Cost>
void PutTimes(const Cost& cost, std::span<const TimeMember<Cost>> members,
              Json* json) {
  for (const auto& [name, time] : members) {
    if (cost.*time != kNever) (*json)[std::string(name)] = cost.*time;
  }
}

Json BlocksJson(const BlockCosts& costs) {
  Json json = Json::object();
  for (const Block block : kBlocks) {
    const BlockCost& cost = costs[static_cast<std::size_t>(block)];
    Json& member = json[std::string(Name(block))];
    PutTimes<BlockCost>(cost, kBlockTimes, &member);
    if (!cost.spread.empty()) member["spread"] = cost.spread;
  }
  return json;
}

Json BarrierJson(const BarrierCost& cost) {
  Json json;
  PutTimes<BarrierCost>(cost, kBarrierTimes, &json);
  if (cost.round) json["round"] = *cost.round;
  if (cost.level) json["level"] = *cost.level;
  return json;
}

Json WaitJson(const WaitCost& cost) {
  Json json = {{"barrier", BarrierJson(cost.barrier)}};
  PutTimes<WaitCost>(cost, kWaitTimes, &json);
  return json;
}

Json ConditionJson(const Condition& condition) {
  Json waits = Json::object();
  for (const auto& [kind, cost] : condition.waits) {
    waits[std::string(Name(kind))] = WaitJson(cost);
  }
  return {{"name", condition.name},
          {"share", condition.share},
          {"point_line", condition.point_line},
          {"tip_line", condition.tip_line},
          {"waits", waits}};
}

Json MachineJson(const MachineModel& machine) {
  Json json = {{"format", kFormat},          {"name", machine.name},
               {"source", machine.source},   {"processors", machine.processors},
               {"lanes", Json::object()},    {"slowdowns", Json::array()},
               {"conditions", Json::array()}};
  for (const auto& [width, costs] : machine.lanes) {
    json["lanes"][std::to_string(width)] = BlocksJson(costs);
  }
  for (const Slowdown& slowdown : machine.slowdowns) {
    json["slowdowns"].push_back({{"from_processors", slowdown.from_processors},
                                 {"lanes", slowdown.lanes},
                                 {"factor", slowdown.factor},
                                 {"why", slowdown.why}});
  }
  for (const Condition& condition : machine.conditions) {
    json["conditions"].push_back(ConditionJson(condition));
  }
  return json;
}

// Like dump(), but what contains no object takes one line: a spread of many
// figures belongs beside its block.
std::string Print(const Json& json, const std::string& margin) {
  if (!json.is_structured()) {
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
  }
  const bool one_line =
      std::none_of(json.begin(), json.end(),
                   [](const Json& part) { return part.is_object(); });
  const std::string inner = margin + "  ";
  std::vector<std::string> parts;
  for (const auto& [key, part] : json.items()) {
    parts.push_back((json.is_object() ? Json(key).dump() + ": " : "") +
                    Print(part, inner));
  }
  const std::string all =
      one_line ? fmt::format("{}", fmt::join(parts, ", "))
               : fmt::format("\n{}{}\n{}", inner,
                             fmt::join(parts, ",\n" + inner), margin);
  return json.is_object() ? "{" + all + "}" : "[" + all + "]";
}

}  // namespace

MachineModel ParseMachine(std::string_view text, std::string_view name) {
  const Json json = ParseJson(text, name);
  const Value file(&json, name, "");
  if (!json.is_object()) file.Expect("an object");
  // First: another format has other members.
  const Value format = file["format"];
  if (format.TextOrNone() != kFormat) {
    format.Expect(fmt::format("\"{}\"", kFormat));
  }
  file.ExpectObject({"format", "name", "source", "processors", "lanes",
                     "slowdowns", "conditions"});
  return {.name = file["name"].Text(),
          .source = file["source"].TextOrNone(),
          .processors = NumProcessors(file["processors"]),
          .lanes = ReadLanes(file["lanes"]),
          .conditions = ReadConditions(file["conditions"]),
          .slowdowns = ReadSlowdowns(file["slowdowns"])};
}

std::string MachineText(const MachineModel& machine) {
  return Print(MachineJson(machine), "") + "\n";
}

MachineModel ReadMachine(const std::string& path) {
  return ParseMachine(macrotask::ReadWholeFile(path), "'" + path + "'");
}

}  // namespace bench::predict
