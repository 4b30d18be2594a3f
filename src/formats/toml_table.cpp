#include "formats/toml_table.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "core/error.h"
#include "formats/mesh_file.h"

namespace nephroid {
namespace {

std::string spelled(double value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

}  // namespace

toml::table parseToml(const std::string& text, const std::string& name) {
  try {
    return toml::parse(text, name);
  } catch (const toml::parse_error& error) {
    throw InputError(oneLine(name + ":" + std::to_string(error.source().begin.line) +
                             ": not TOML: " + std::string(error.description())));
  }
}

TomlTable::TomlTable(const toml::table& table, std::string file, std::string name)
    : table_(&table), file_(std::move(file)), name_(std::move(name)) {}

const toml::node* TomlTable::find(const std::string& key) {
  if (std::find(known_.begin(), known_.end(), key) == known_.end()) known_.push_back(key);
  return table_->get(key);
}

bool TomlTable::has(const std::string& key) {
  return find(key) != nullptr;
}

bool TomlTable::isText(const std::string& key) {
  const toml::node* node = find(key);
  return node && node->is_string();
}

std::string TomlTable::at(const std::string& key) const {
  const toml::node* node = table_->get(key);
  const auto line = (node ? node->source() : table_->source()).begin.line;
  std::string place = file_;
  if (line > 0) place.append(":").append(std::to_string(line));
  place.append(": ");
  if (!name_.empty()) place.append(name_).append(": ");
  return place;
}

void TomlTable::fail(const std::string& key, const std::string& what) const {
  throw InputError(oneLine(at(key) + "\"" + key + "\" " + what));
}

void TomlTable::missing(const std::string& key) const {
  throw InputError(oneLine(at(key) + "needs \"" + key + "\""));
}

double TomlTable::checked(const std::string& key, const toml::node& node, Range range, bool integer) const {
  const std::string kind = integer ? "a whole number" : "a number";
  if (!(integer ? node.is_integer() : node.is_number())) fail(key, "must be " + kind);
  const double value =
      node.is_integer() ? static_cast<double>(node.as_integer()->get()) : node.as_floating_point()->get();
  if (!(value >= range.lowest && value <= range.highest)) {
    fail(key, "is " + spelled(value) + "; it must be " + kind + " from " + spelled(range.lowest) + " to " +
                  spelled(range.highest));
  }
  return value;
}

std::vector<double> TomlTable::numbers(const std::string& key, const toml::node& node, std::size_t count,
                                       Range range, bool integer) const {
  const toml::array* array = node.as_array();
  if (!array || array->size() != count) {
    fail(key, "must be an array of " + std::to_string(count) + (integer ? " whole numbers" : " numbers"));
  }
  std::vector<double> values;
  for (const toml::node& element : *array) values.push_back(checked(key, element, range, integer));
  return values;
}

std::optional<std::string> TomlTable::text(const std::string& key) {
  const toml::node* node = find(key);
  if (!node) return std::nullopt;
  if (!node->is_string()) fail(key, "must be text in quotes");
  const std::string value = *node->value<std::string>();
  if (value.empty()) fail(key, "must not be empty");
  if (value.find('\0') != value.npos) fail(key, "must not hold a zero character");
  return value;
}

std::optional<bool> TomlTable::boolean(const std::string& key) {
  const toml::node* node = find(key);
  if (!node) return std::nullopt;
  if (!node->is_boolean()) fail(key, "must be true or false");
  return node->as_boolean()->get();
}

std::optional<double> TomlTable::number(const std::string& key, Range range) {
  const toml::node* node = find(key);
  if (!node) return std::nullopt;
  return checked(key, *node, range, false);
}

std::optional<int64_t> TomlTable::integer(const std::string& key, Range range) {
  const toml::node* node = find(key);
  if (!node) return std::nullopt;
  return static_cast<int64_t>(checked(key, *node, range, true));
}

std::optional<vec2> TomlTable::vector2(const std::string& key, Range range) {
  const toml::node* node = find(key);
  if (!node) return std::nullopt;
  const auto v = numbers(key, *node, 2, range, false);
  return vec2(v[0], v[1]);
}

std::optional<vec3> TomlTable::vector3(const std::string& key, Range range) {
  const toml::node* node = find(key);
  if (!node) return std::nullopt;
  const auto v = numbers(key, *node, 3, range, false);
  return vec3(v[0], v[1], v[2]);
}

std::vector<vec3> TomlTable::vectors3(const std::string& key) {
  const toml::node* node = find(key);
  std::vector<vec3> vectors;
  if (!node) return vectors;
  if (!node->is_array()) fail(key, "must be a list of arrays of 3 numbers");
  for (const toml::node& element : *node->as_array()) {
    const auto v = numbers(key, element, 3, kAnyNumber, false);
    vectors.emplace_back(v[0], v[1], v[2]);
  }
  return vectors;
}

std::optional<vec3> TomlTable::numberOrRgb(const std::string& key, Range range) {
  const toml::node* node = find(key);
  if (!node) return std::nullopt;
  if (node->is_array()) return vector3(key, range);
  if (!node->is_number()) fail(key, "must be a number or [r, g, b]");
  return vec3(static_cast<float>(checked(key, *node, range, false)));
}

std::optional<uvec2> TomlTable::integers2(const std::string& key, Range range) {
  const toml::node* node = find(key);
  if (!node) return std::nullopt;
  const auto v = numbers(key, *node, 2, range, true);
  return uvec2(v[0], v[1]);
}

std::vector<TomlTable> TomlTable::tables(const std::string& key) {
  const toml::node* node = find(key);
  std::vector<TomlTable> result;
  if (!node) return result;
  const toml::array* array = node->as_array();
  const bool isTop = name_.empty();
  if (!array) fail(key, isTop ? "must be written [[" + key + "]]" : "must be an array of tables");
  for (const toml::node& element : *array) {
    if (!element.is_table())
      fail(key, isTop ? "must be written [[" + key + "]]" : "must be an array of tables");
    const std::string name = isTop ? "[[" + key + "]]" : name_ + " " + key;
    result.emplace_back(*element.as_table(), file_, name + " " + std::to_string(result.size() + 1));
  }
  return result;
}

std::optional<TomlTable> TomlTable::table(const std::string& key) {
  const toml::node* node = find(key);
  if (!node) return std::nullopt;
  if (!node->is_table()) fail(key, "must be a table");
  return TomlTable(*node->as_table(), file_, name_ + " " + key);
}

std::optional<double> TomlTable::numberAt(const std::string& key, Range range, double time) {
  const toml::node* node = find(key);
  if (!node || !node->is_array()) return number(key, range);
  std::vector<glm::dvec2> marks;  // time, value
  for (const toml::node& element : *node->as_array()) {
    const toml::array* pair = element.as_array();
    if (!pair || pair->size() != 2) fail(key, "must be a number or a list of [time, value]");
    marks.emplace_back(checked(key, *pair->get(0), kAnyNumber, false),
                       checked(key, *pair->get(1), range, false));
    if (marks.size() > 1 && !(marks.back().x > marks[marks.size() - 2].x))
      fail(key, "has times that do not ascend; each must be later than the one before it");
  }
  if (marks.empty()) fail(key, "is an empty list; it must hold at least one [time, value]");
  const auto next = std::ranges::find_if(marks, [&](const glm::dvec2& mark) { return mark.x >= time; });
  if (next == marks.begin()) return next->y;
  if (next == marks.end()) return marks.back().y;
  const glm::dvec2 before = *(next - 1);
  return glm::mix(before.y, next->y, (time - before.x) / (next->x - before.x));
}

std::string TomlTable::requiredText(const std::string& key) {
  const auto value = text(key);
  if (!value) missing(key);
  return *value;
}

vec3 TomlTable::requiredVector3(const std::string& key, Range range) {
  const auto value = vector3(key, range);
  if (!value) missing(key);
  return *value;
}

vec3 TomlTable::requiredNumberOrRgb(const std::string& key, Range range) {
  const auto value = numberOrRgb(key, range);
  if (!value) missing(key);
  return *value;
}

std::size_t TomlTable::choice(const std::string& key, const std::vector<std::string>& names) {
  const auto name = text(key);
  if (!name) return 0;
  const auto found = std::find(names.begin(), names.end(), *name);
  if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
  const std::string nearest = nearestName(*name, names);
  std::string all;
  for (const std::string& known : names) all += (all.empty() ? "" : ", ") + known;
  fail(key,
       "is \"" + *name + "\", which is not known; " +
           (nearest.empty() ? "it must be one of " + all : "the nearest known one is \"" + nearest + "\""));
}

void TomlTable::finish() const {
  for (const auto& [key, node] : *table_) {
    const std::string name(key.str());
    if (std::find(known_.begin(), known_.end(), name) != known_.end()) continue;
    const std::string nearest = nearestName(name, known_);
    std::string all;
    for (const std::string& known : known_) all += (all.empty() ? "" : ", ") + known;
    throw InputError(
        oneLine(file_ + ":" + std::to_string(key.source().begin.line) + ": " +
                (name_.empty() ? "" : name_ + ": ") + "unknown key \"" + name + "\"; " +
                (nearest.empty() ? "known are " + all : "the nearest known one is \"" + nearest + "\"")));
  }
}

}  // namespace nephroid
