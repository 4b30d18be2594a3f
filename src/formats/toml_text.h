// Changes single values in the text of a TOML file. Everything else stays as it was written, with comments
// and layout.
#pragma once

#include <toml++/toml.h>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/shared_language.h"

namespace nephroid {

// Keys and values, in TOML's syntax.
using TomlEntries = std::vector<std::pair<std::string, std::string>>;

class TomlText {
 public:
  // Throws InputError, with `name`, where the text is not TOML.
  TomlText(std::string text, const std::string& name);

  const toml::table& root() const { return root_; }
  // The tables of [[key]], in their order.
  std::vector<const toml::table*> tables(std::string_view key) const;
  // The table [key]; null where there is none.
  const toml::table* table(std::string_view key) const;

  // Replaces the value of `key` in `table` (a table of root), or adds it as the first one. `value` is in
  // TOML's syntax.
  void set(const toml::table& table, const std::string& key, const std::string& value);
  // The same in [section], which is added at the end where it is missing.
  void set(const std::string& section, const std::string& key, const std::string& value);
  // Replaces an existing key and its value by another key and value.
  void replace(const toml::table& table, const std::string& key, const std::string& newKey,
               const std::string& value);

  // Adds a table before `table`, the first one of the list `key`, in the same style.
  void prepend(const toml::table& table, const std::string& key, const TomlEntries& entries);

  // The text with all changes.
  std::string text() const;

 private:
  struct Change {
    std::size_t begin = 0, end = 0;  // the part of the text that is replaced
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
  std::vector<std::pair<std::string, std::string>> added_;  // new sections and their text
};

// Values in TOML's syntax. Numbers have the fewest digits from which the same float is read.
std::string tomlString(const std::string& text);
std::string tomlNumber(float value);
std::string tomlVector(vec3 value);
std::string tomlColor(vec3 value);  // one number where the channels are equal
std::string tomlInlineTable(const TomlEntries& entries);

}  // namespace nephroid
