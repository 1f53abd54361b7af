#include "bench/predict/machine_file.h"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <limits>
#include <nlohmann/json.hpp>
#include <span>
#include <utility>

#include "bench/predict/json_value.h"
#include "macrotask/whole_file.h"

namespace bench::predict {
namespace {

using macrotask::WaitKind;

constexpr std::string_view kFormat = "macrotask machine 1";
constexpr WaitKind kWaitKinds[] = {WaitKind::kBlock, WaitKind::kSpin,
                                   WaitKind::kHold, WaitKind::kLogical};
constexpr Block kBlocks[] = {Block::kStart, Block::kCs,  Block::kOcd,
                             Block::kRma,   Block::kCcd, Block::kShift,
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

// An object of `members` and of `others`, which the caller reads.
template <typename Cost>
Cost ReadTimes(const JsonValue& value,
               std::span<const TimeMember<Cost>> members,
               std::initializer_list<std::string_view> others) {
  std::vector<std::string_view> names;
  for (const auto& member : members) names.push_back(member.name);
  names.insert(names.end(), others);
  value.ExpectObject(names);
  Cost cost;
  for (const auto& [name, time] : members) {
    cost.*time = value[name].Time().value_or(cost.*time);
  }
  return cost;
}

Spread ReadSpread(const JsonValue& value) {
  Spread spread;
  for (const JsonValue& ratio : value.Elements()) {
    spread.push_back(
        ratio.Number(spread.empty() ? std::numeric_limits<double>::denorm_min()
                                    : spread.back(),
                     "a ratio above 0 and not below the one before"));
  }
  return spread;
}

BlockCost ReadBlock(const JsonValue& value) {
  auto cost = ReadTimes<BlockCost>(value, kBlockTimes, {"spread"});
  cost.spread = ReadSpread(value["spread"]);
  return cost;
}

BlockCosts ReadBlocks(const JsonValue& value) {
  std::vector<std::string_view> names;
  for (const Block block : kBlocks) names.push_back(Name(block));
  value.ExpectObject(names);
  BlockCosts costs;
  for (const Block block : kBlocks) {
    costs[static_cast<std::size_t>(block)] = ReadBlock(value[Name(block)]);
  }
  return costs;
}

std::map<int, BlockCosts> ReadLanes(const JsonValue& value) {
  if (value.is_missing()) value.Expect("an object");
  value.ExpectObject({"1", "4"});
  std::map<int, BlockCosts> lanes;
  for (const int width : {1, 4}) {
    const JsonValue costs = value[std::to_string(width)];
    if (!costs.is_missing()) lanes[width] = ReadBlocks(costs);
  }
  return lanes;
}

BarrierCost ReadBarrier(const JsonValue& value) {
  auto cost = ReadTimes<BarrierCost>(value, kBarrierTimes, {"round", "level"});
  cost.round = value["round"].Time();
  cost.level = value["level"].Time();
  return cost;
}

WaitCost ReadWait(const JsonValue& value) {
  auto cost = ReadTimes<WaitCost>(value, kWaitTimes, {"barrier"});
  cost.barrier = ReadBarrier(value["barrier"]);
  return cost;
}

std::map<WaitKind, WaitCost> ReadWaits(const JsonValue& value) {
  std::vector<std::string_view> names;
  for (const WaitKind kind : kWaitKinds) names.push_back(Name(kind));
  value.ExpectObject(names);
  if (value.is_empty()) value.Expect("an object of at least one way to wait");
  std::map<WaitKind, WaitCost> waits;
  for (const WaitKind kind : kWaitKinds) {
    const JsonValue cost = value[Name(kind)];
    if (!cost.is_missing()) waits[kind] = ReadWait(cost);
  }
  return waits;
}

Condition ReadCondition(const JsonValue& value) {
  value.ExpectObject({"name", "share", "point_line", "tip_line", "waits"});
  const JsonValue share = value["share"];
  return {.name = value["name"].TextOrNone(),
          .share = share.is_missing() ? 1 : share.Number(0, "a share, 0 to 1"),
          .point_line = value["point_line"].Time().value_or(0),
          .tip_line = value["tip_line"].Time().value_or(0),
          .waits = ReadWaits(value["waits"])};
}

std::vector<Condition> ReadConditions(const JsonValue& value) {
  if (value.is_empty()) value.Expect("an array of at least one condition");
  std::vector<Condition> conditions;
  double sum = 0;
  for (const JsonValue& element : value.Elements()) {
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

Slowdown ReadSlowdown(const JsonValue& value,
                      const std::vector<Slowdown>& others) {
  value.ExpectObject({"from_processors", "lanes", "factor", "why"});
  const JsonValue from = value["from_processors"], factor = value["factor"];
  const JsonValue lanes = value["lanes"];
  Slowdown slowdown = {.why = value["why"].TextOrNone()};
  if (!from.is_missing()) slowdown.from_processors = from.Count();
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

std::vector<Slowdown> ReadSlowdowns(const JsonValue& value) {
  std::vector<Slowdown> slowdowns;
  for (const JsonValue& element : value.Elements()) {
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

}  // namespace

MachineModel ParseMachine(std::string_view text, std::string_view name) {
  const Json json = ParseJson(text, name);
  const JsonValue file(json, name);
  if (!json.is_object()) file.Expect("an object");
  // First: another format has other members.
  const JsonValue format = file["format"];
  if (format.TextOrNone() != kFormat) {
    format.Expect(fmt::format("\"{}\"", kFormat));
  }
  file.ExpectObject({"format", "name", "source", "processors", "lanes",
                     "slowdowns", "conditions"});
  return {.name = file["name"].Text(),
          .source = file["source"].TextOrNone(),
          .processors = file["processors"].Count(),
          .lanes = ReadLanes(file["lanes"]),
          .conditions = ReadConditions(file["conditions"]),
          .slowdowns = ReadSlowdowns(file["slowdowns"])};
}

std::string MachineText(const MachineModel& machine) {
  return JsonText(MachineJson(machine)) + "\n";
}

MachineModel ReadMachine(const std::string& path) {
  return ParseMachine(macrotask::ReadWholeFile(path), "'" + path + "'");
}

}  // namespace bench::predict
