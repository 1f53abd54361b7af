#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

// JSON files that people write by hand, read so that whatever is wrong with one
// is told in one sentence:
//
//   machine.json has -1 at conditions[0].waits.hold.event: expected a time in
//   seconds, 0 or more

namespace bench::predict {

using Json = nlohmann::ordered_json;

// The value that `text` is. Throws std::runtime_error, one sentence that begins
// with `file`, if it is no JSON, and where, or has a member of an object twice
// or a number beyond all doubles.
Json ParseJson(std::string_view text, std::string_view file);

// The other way round. Like dump(), but what contains no object takes one line:
// a row of many figures belongs beside its name. Bytes that are no UTF-8 are
// replaced.
std::string JsonText(const Json& json);

// A value of a file, and where it is. What belongs to a value that is missing
// is missing as well, so that everything that may be left out can be read.
//
// All functions that read throw std::runtime_error, one sentence that begins
// with the name of the file, if the value is not as they say. `json` and `file`
// must outlive it.
class JsonValue {
 public:
  // All of the file.
  JsonValue(const Json& json, std::string_view file)
      : JsonValue(&json, file, "") {}

  bool is_missing() const { return json_ == nullptr; }
  bool is_empty() const;  // or missing

  // Throws: the file has `found`, or this value, and `expected` was expected.
  [[noreturn]] void Fail(std::string_view found,
                         std::string_view expected) const;
  [[noreturn]] void Expect(std::string_view expected) const;

  // Throws unless it is missing, or an object of no other members than these.
  void ExpectObject(const std::vector<std::string_view>& keys) const;

  // A member; missing if it is not there. Requires: ExpectObject().
  JsonValue operator[](std::string_view key) const;
  // Of an array; none if it is missing.
  std::vector<JsonValue> Elements() const;

  // `least` or more; `expected` says so.
  double Number(double least, std::string_view expected) const;
  int Count() const;                   // a whole number above 0
  std::optional<double> Time() const;  // in seconds, 0 or more; or missing
  std::string Text() const;
  std::string TextOrNone() const;  // or missing

 private:
  JsonValue(const Json* json, std::string_view file, std::string path)
      : json_(json), file_(file), path_(std::move(path)) {}

  std::string Description() const;

  const Json* json_;  // null if it is missing
  std::string_view file_;
  std::string path_;
};

}  // namespace bench::predict
