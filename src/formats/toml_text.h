// The text of a TOML file in which single values are changed and all else stays as it was written, comments
// and layout included.
#pragma once

#include <toml++/toml.h>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/shared_language.h"

namespace nephroid {

// Keys and values, as TOML has them.
using TomlEntries = std::vector<std::pair<std::string, std::string>>;

class TomlText {
 public:
  // Throws InputError, with `name`, where it is not TOML.
  TomlText(std::string text, const std::string& name);

  const toml::table& root() const { return root_; }
  // The tables of [[key]], in their order.
  std::vector<const toml::table*> tables(std::string_view key) const;
  // The table [key], none where there is none.
  const toml::table* table(std::string_view key) const;

  // In place of the value that `table` (of root) has, or else as its first. `value` is as TOML has it.
  void set(const toml::table& table, const std::string& key, const std::string& value);
  // In [section], which is added at the end where there is none.
  void set(const std::string& section, const std::string& key, const std::string& value);
  // Another key and value in place of `key`, which is there.
  void replace(const toml::table& table, const std::string& key, const std::string& newKey,
               const std::string& value);

  // A table before those of the list `key`, which has some: written as the first of them is.
  void prepend(const toml::table& table, const std::string& key, const TomlEntries& entries);

  // With all that was set.
  std::string text() const;

 private:
  struct Change {
    std::size_t begin = 0, end = 0;  // what of the text is replaced
    std::string by;
  };
  std::size_t offsetOf(toml::source_position position) const;
  void insert(std::size_t at, std::string text) { changes_.push_back({at, at, std::move(text)}); }
  std::string slice(std::size_t begin, std::size_t end) const { return text_.substr(begin, end - begin); }

  std::string text_;
  std::string name_;
  toml::table root_;
  std::vector<std::size_t> lineStarts_;
  std::vector<Change> changes_;
  std::vector<std::pair<std::string, std::string>> added_;  // sections that were not there, and their text
};

// As TOML has them. Numbers in as few digits as give the same float again.
std::string tomlString(const std::string& text);
std::string tomlNumber(float value);
std::string tomlVector(vec3 value);
std::string tomlColor(vec3 value);  // one number where the channels are alike
std::string tomlInlineTable(const TomlEntries& entries);

}  // namespace nephroid
