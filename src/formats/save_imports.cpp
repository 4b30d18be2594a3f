#include "formats/save_imports.h"

#include <algorithm>
#include <cmath>

namespace nephroid {
namespace {

TomlEntries changesOf(const Light& before, const Light& after) {
  TomlEntries changes;
  const auto add = [&](const char* key, const auto& was, const auto& is, const std::string& value) {
    if (was != is) changes.emplace_back(key, value);
  };
  add("position", before.position, after.position, tomlVector(after.position));
  add("direction", before.direction, after.direction, tomlVector(after.direction));
  if (before.type == LightType::directional)
    add("illuminance", before.illuminance, after.illuminance, tomlColor(after.illuminance));
  else
    add("intensity", before.intensity, after.intensity, tomlColor(after.intensity));
  add("inner_angle", before.innerAngle, after.innerAngle, tomlNumber(after.innerAngle));
  add("outer_angle", before.outerAngle, after.outerAngle, tomlNumber(after.outerAngle));
  return changes;
}

TomlEntries changesOf(const Object& before, const Object& after) {
  TomlEntries changes;
  const Placement &was = before.placement, &is = after.placement;
  if (was.translation != is.translation) changes.emplace_back("translation", tomlVector(is.translation));
  if (was.rotation != is.rotation) changes.emplace_back("rotation", tomlVector(eulerDegrees(is.rotation)));
  if (was.scale != is.scale) changes.emplace_back("scale", tomlNumber(is.scale));
  return changes;
}

TomlEntries changesOf(const Material& before, const Material& after) {
  TomlEntries changes;
  if (before.type != MaterialType::dielectric) {
    if (before.color != after.color) changes.emplace_back("color", tomlColor(after.color));
    return changes;
  }
  if (before.ior != after.ior || before.dispersion != after.dispersion) {
    changes.emplace_back("ior", after.dispersion > 0 ? tomlNumber(after.ior.y) : tomlColor(after.ior));
    if (after.dispersion > 0) changes.emplace_back("abbe", tomlNumber(20 / after.dispersion));
  }
  if (before.attenuationColor != after.attenuationColor ||
      before.attenuationDistance != after.attenuationDistance) {
    const bool isTinted = std::isfinite(after.attenuationDistance);
    changes.emplace_back("attenuation_color", tomlVector(isTinted ? after.attenuationColor : vec3(1)));
    if (isTinted) changes.emplace_back("attenuation_distance", tomlNumber(after.attenuationDistance));
  }
  return changes;
}

const toml::table* tableNamed(const toml::array* list, const std::string& name) {
  if (!list) return nullptr;
  for (const toml::node& node : *list)
    if (const toml::table* table = node.as_table(); table && (*table)["name"].value_or(std::string()) == name)
      return table;
  return nullptr;
}

// In the tables `key` of `table`, each with the name that the file has.
template <class Element>
void saveChanges(const std::vector<Element>& before, const std::vector<Element>& after,
                 const std::string& prefix, const toml::table& table, const char* key, TomlText& text,
                 std::vector<std::string>& notSaved) {
  const toml::array* list = table.get_as<toml::array>(key);
  std::string added;
  for (std::size_t i = 0; i < before.size(); ++i) {
    const std::string& name = before[i].name;
    const TomlEntries changes = changesOf(before[i], after[i]);
    // The first of several that share a name is the one that is meant by it.
    if (!name.starts_with(prefix) || changes.empty() ||
        std::ranges::find(before, name, &Element::name) != before.begin() + std::ptrdiff_t(i))
      continue;
    const auto said = std::ranges::find(notSaved, name);
    if (said != notSaved.end()) notSaved.erase(said);
    const std::string own = name.substr(prefix.size());
    if (const toml::table* there = tableNamed(list, own)) {
      for (const auto& [entry, value] : changes) text.set(*there, entry, value);
      continue;
    }
    TomlEntries entries{{"name", tomlString(own)}};
    entries.insert(entries.end(), changes.begin(), changes.end());
    if (list && !list->empty())
      text.prepend(table, key, entries);
    else
      added += (added.empty() ? "" : ", ") + tomlInlineTable(entries);
  }
  if (!added.empty()) text.set(table, key, "[" + added + "]");
}

}  // namespace

vec3 eulerDegrees(quat rotation) {
  const mat3 m = glm::mat3_cast(rotation);
  const float sinY = glm::clamp(-m[0][2], -1.0f, 1.0f);
  vec3 angles(std::atan2(m[1][2], m[2][2]), std::asin(sinY), std::atan2(m[0][1], m[0][0]));
  if (std::abs(sinY) > 0.99999f) angles = {std::atan2(-m[2][1], m[1][1]), angles.y, 0};
  return glm::degrees(angles);
}

void saveImported(const Scene& before, const Scene& after, const std::string& prefix,
                  const toml::table& table, TomlText& text, std::vector<std::string>& notSaved) {
  saveChanges(before.lights, after.lights, prefix, table, "light", text, notSaved);
  saveChanges(before.objects, after.objects, prefix, table, "part", text, notSaved);
  saveChanges(before.materials, after.materials, prefix, table, "material", text, notSaved);
}

}  // namespace nephroid
