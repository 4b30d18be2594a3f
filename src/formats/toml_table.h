// Typed, checked access to a table of a scene file: every key that is asked for becomes known, every value is
// held against its range, and whatever is left over at the end is an error that names the nearest known key.
#pragma once

#include <toml++/toml.h>
#include <optional>
#include <string>
#include <vector>

#include "core/shared_language.h"

namespace nephroid {

// Closed on both sides.
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
  // `file` and `name` ("object \"ball\"", "camera") begin every error.
  TomlTable(const toml::table& table, std::string file, std::string name);

  bool has(const std::string& key);
  void setName(std::string name) { name_ = std::move(name); }

  std::optional<std::string> text(const std::string& key);
  std::optional<double> number(const std::string& key, Range range = kAnyNumber);
  std::optional<int64_t> integer(const std::string& key, Range range);
  std::optional<vec2> vector2(const std::string& key, Range range = kAnyNumber);
  std::optional<vec3> vector3(const std::string& key, Range range = kAnyNumber);
  std::vector<vec3> vectors3(const std::string& key);  // a list of them; empty where the key is missing
  std::optional<vec3> numberOrRgb(const std::string& key, Range range);
  std::optional<uvec2> integers2(const std::string& key, Range range);
  std::vector<TomlTable> tables(const std::string& key);
  std::optional<TomlTable> table(const std::string& key);

  // A number, or what a list of [time, value] comes to at `time` (s): linear between the times, which ascend,
  // and constant before the first and after the last.
  std::optional<double> numberAt(const std::string& key, Range range, double time);

  // As above, where the key must be there.
  std::string requiredText(const std::string& key);
  vec3 requiredVector3(const std::string& key, Range range = kAnyNumber);
  vec3 requiredNumberOrRgb(const std::string& key, Range range);

  // One of `names`; the position in it. Where the key is missing, the first.
  std::size_t choice(const std::string& key, const std::vector<std::string>& names);

  // Ends the reading: a key nobody asked for is an error.
  void finish() const;

  // "FILE:LINE: [[object]] "ball": " of the key, or of the table for a key that is not there.
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
