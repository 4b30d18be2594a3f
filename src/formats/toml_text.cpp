#include "formats/toml_text.h"

#include <algorithm>
#include <charconv>

#include "core/error.h"
#include "formats/toml_table.h"

namespace nephroid {
namespace {

// Begins a code point of UTF-8, which is what columns count.
bool beginsCharacter(char c) {
  return (static_cast<unsigned char>(c) & 0xc0u) != 0x80u;
}

const toml::key* keyNamed(const toml::table& table, const std::string& name) {
  for (const auto& [key, node] : table)
    if (key.str() == name) return &key;
  return nullptr;
}

}  // namespace

std::string tomlString(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    result += c;
  }
  return result + '"';
}

std::string tomlNumber(float value) {
  char text[32];
  const auto [end, error] = std::to_chars(text, text + sizeof text, value == 0 ? 0.0f : value);
  return {text, end};
}

std::string tomlVector(vec3 value) {
  return "[" + tomlNumber(value.x) + ", " + tomlNumber(value.y) + ", " + tomlNumber(value.z) + "]";
}

std::string tomlColor(vec3 value) {
  return value.x == value.y && value.y == value.z ? tomlNumber(value.x) : tomlVector(value);
}

std::string tomlInlineTable(const TomlEntries& entries) {
  std::string text = "{";
  for (const auto& [key, value] : entries)
    text.append(text.size() == 1 ? " " : ", ").append(key).append(" = ").append(value);
  return text + " }";
}

TomlText::TomlText(std::string text, const std::string& name)
    : text_(std::move(text)), name_(name), root_(parseToml(text_, name)) {
  lineStarts_.push_back(0);
  for (std::size_t i = 0; i < text_.size(); ++i)
    if (text_[i] == '\n') lineStarts_.push_back(i + 1);
}

std::vector<const toml::table*> TomlText::tables(std::string_view key) const {
  std::vector<const toml::table*> tables;
  const toml::array* array = root_.get_as<toml::array>(key);
  if (!array) return tables;
  for (const toml::node& node : *array)
    if (const toml::table* table = node.as_table()) tables.push_back(table);
  return tables;
}

const toml::table* TomlText::table(std::string_view key) const {
  return root_.get_as<toml::table>(key);
}

std::size_t TomlText::offsetOf(toml::source_position position) const {
  std::size_t offset = lineStarts_.at(position.line - 1);
  for (uint32_t column = 1; column < position.column && offset < text_.size(); ++column) {
    do ++offset;
    while (offset < text_.size() && !beginsCharacter(text_[offset]));
  }
  return offset;
}

void TomlText::set(const toml::table& table, const std::string& key, const std::string& value) {
  if (const toml::node* node = table.get(key)) {
    changes_.push_back({offsetOf(node->source().begin), offsetOf(node->source().end), value});
    return;
  }
  const std::size_t begin = offsetOf(table.source().begin);
  if (begin < text_.size() && text_[begin] == '{') {
    insert(begin + 1, " " + key + " = " + value + (table.empty() ? "" : ","));
  } else if (begin < text_.size() && text_[begin] == '[') {
    insert(std::min(text_.find('\n', begin), text_.size()), "\n" + key + " = " + value);
  } else {
    throw InputError(name_ + ":" + std::to_string(table.source().begin.line) + ": \"" + key +
                     "\" cannot be added to a table that is written so; write it [...] or [[...]]");
  }
}

void TomlText::set(const std::string& section, const std::string& key, const std::string& value) {
  if (const toml::table* there = table(section)) return set(*there, key, value);
  const auto found = std::ranges::find(added_, section, &std::pair<std::string, std::string>::first);
  std::string& text = found != added_.end() ? found->second : added_.emplace_back(section, "").second;
  text += key + " = " + value + "\n";
}

void TomlText::replace(const toml::table& table, const std::string& key, const std::string& newKey,
                       const std::string& value) {
  const toml::key* old = keyNamed(table, key);
  changes_.push_back(
      {offsetOf(old->source().begin), offsetOf(table.get(key)->source().end), newKey + " = " + value});
}

void TomlText::prepend(const toml::table& table, const std::string& key, const TomlEntries& entries) {
  const toml::array& list = *table.get_as<toml::array>(key);
  const std::size_t first = offsetOf(list.front().source().begin);
  const std::size_t line = text_.rfind('\n', first) + 1;
  if (text_[first] == '{') {
    const std::string indent = slice(line, first);
    const bool beginsLine = indent.find_first_not_of(" \t") == std::string::npos;
    return insert(first, tomlInlineTable(entries) + (beginsLine ? ",\n" + indent : ", "));
  }
  std::string text = slice(first, text_.find("]]", first) + 2);
  for (const auto& [name, value] : entries) text.append("\n").append(name).append(" = ").append(value);
  insert(first, text + "\n\n");
}

std::string TomlText::text() const {
  std::vector<Change> changes = changes_;
  std::ranges::stable_sort(changes, {}, &Change::begin);
  std::string result;
  std::size_t done = 0;
  for (const Change& change : changes) {
    result += slice(done, change.begin) + change.by;
    done = change.end;
  }
  result += slice(done, text_.size());
  for (const auto& [section, text] : added_) {
    if (!result.empty() && result.back() != '\n') result += '\n';
    result.append("\n[").append(section).append("]\n").append(text);
  }
  return result;
}

}  // namespace nephroid
