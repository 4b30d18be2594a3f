// Reads a table of a scene file with checks. Every value is checked against its range. Every key that is
// asked for counts as known; at the end, a key that was not asked for is an error, whose message has the
// nearest known key.
#pragma once

#include <toml++/toml.h>
#include <optional>
#include <string>
#include <vector>

#include "core/shared_language.h"

namespace nephroid {

// Both ends are included.
struct Range {
  double lowest = -1e9;
  double highest = 1e9;
};

inline constexpr Range kAnyNumber{};
inline constexpr Range kNotNegative{0, 1e12};
inline constexpr Range kPositive{1e-6, 1e9};
inline constexpr Range kFraction{0, 1};

// Throws InputError with `name`, the line and what is wrong.
toml::table parseToml(const std::string& text, const std::string& name);

class TomlTable {
 public:
  // Error messages begin with `file` and `name` ("object \"ball\"", "camera").
  TomlTable(const toml::table& table, std::string file, std::string name);

  bool has(const std::string& key);
  bool isText(const std::string& key);
  void setName(std::string name) { name_ = std::move(name); }

  std::optional<std::string> text(const std::string& key);
  std::optional<bool> boolean(const std::string& key);
  std::optional<double> number(const std::string& key, Range range = kAnyNumber);
  std::optional<int64_t> integer(const std::string& key, Range range);
  std::optional<vec2> vector2(const std::string& key, Range range = kAnyNumber);
  std::optional<vec3> vector3(const std::string& key, Range range = kAnyNumber);
  std::vector<vec3> vectors3(const std::string& key);  // a list of them; empty where the key is missing
  std::optional<vec3> numberOrRgb(const std::string& key, Range range);
  std::optional<uvec2> integers2(const std::string& key, Range range);
  std::vector<TomlTable> tables(const std::string& key);
  std::optional<TomlTable> table(const std::string& key);

  // Reads a number, or a list of [time, value] pairs with ascending times. Of a list it returns the value at
  // `time` (s): linear between the pairs, and constant before the first and after the last.
  std::optional<double> numberAt(const std::string& key, Range range, double time);

  // As above, but a missing key is an error.
  std::string requiredText(const std::string& key);
  vec3 requiredVector3(const std::string& key, Range range = kAnyNumber);
  vec3 requiredNumberOrRgb(const std::string& key, Range range);

  // Reads one of `names` and returns its index; 0 where the key is missing.
  std::size_t choice(const std::string& key, const std::vector<std::string>& names);

  // Ends the reading. Throws InputError where a key was not asked for.
  void finish() const;

  // The beginning of an error message: "FILE:LINE: [[object]] "ball": ", with the line of the key, or of the
  // table where the key is missing.
  std::string at(const std::string& key) const;
  [[noreturn]] void fail(const std::string& key, const std::string& what) const;

 private:
  const toml::node* find(const std::string& key);
  double checked(const std::string& key, const toml::node& node, Range range, bool integer) const;
  std::vector<double> numbers(const std::string& key, const toml::node& node, std::size_t count, Range range,
                              bool integer) const;
  [[noreturn]] void missing(const std::string& key) const;

  const toml::table* table_;
  std::string file_;
  std::string name_;
  std::vector<std::string> known_;
};

}  // namespace nephroid
