#include "bench/predict/json_value.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>

namespace bench::predict {
namespace {

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

std::string JsonText(const Json& json) { return Print(json, ""); }

bool JsonValue::is_empty() const { return is_missing() || json_->empty(); }

void JsonValue::Fail(std::string_view found, std::string_view expected) const {
  predict::Fail(file_, found, path_, expected);
}

void JsonValue::Expect(std::string_view expected) const {
  Fail(Description(), expected);
}

void JsonValue::ExpectObject(const std::vector<std::string_view>& keys) const {
  if (is_missing()) return;
  if (!json_->is_object()) Expect("an object");
  for (const auto& [key, unused] : json_->items()) {
    if (std::find(keys.begin(), keys.end(), key) == keys.end()) {
      predict::Fail(file_, "an unknown member", MemberPath(path_, key),
                    fmt::format("one of {}", fmt::join(keys, ", ")));
    }
  }
}

JsonValue JsonValue::operator[](std::string_view key) const {
  const Json* member = nullptr;
  if (!is_missing()) {
    const auto found = json_->find(key);
    if (found != json_->end()) member = &*found;
  }
  return {member, file_, MemberPath(path_, key)};
}

std::vector<JsonValue> JsonValue::Elements() const {
  std::vector<JsonValue> elements;
  if (is_missing()) return elements;
  if (!json_->is_array()) Expect("an array");
  for (const Json& json : *json_) {
    elements.push_back(
        JsonValue(&json, file_, ElementPath(path_, elements.size())));
  }
  return elements;
}

double JsonValue::Number(double least, std::string_view expected) const {
  const bool is_right =
      !is_missing() && json_->is_number() && json_->get<double>() >= least;
  if (!is_right) Expect(expected);
  return json_->get<double>();
}

int JsonValue::Count() const {
  constexpr int kMost = std::numeric_limits<int>::max();
  const std::string expected = fmt::format("a whole number, 1 to {}", kMost);
  const double number = Number(1, expected);
  if (number > kMost || number != std::trunc(number)) Expect(expected);
  return static_cast<int>(number);
}

std::optional<double> JsonValue::Time() const {
  if (is_missing()) return std::nullopt;
  return Number(0, "a time in seconds, 0 or more");
}

std::string JsonValue::Text() const {
  if (is_missing() || !json_->is_string()) Expect("a text");
  return json_->get<std::string>();
}

std::string JsonValue::TextOrNone() const { return is_missing() ? "" : Text(); }

std::string JsonValue::Description() const {
  if (is_missing()) return "nothing";
  if (!json_->is_structured()) return json_->dump();
  return fmt::format("an {}{}", is_empty() ? "empty " : "", json_->type_name());
}

}  // namespace bench::predict
