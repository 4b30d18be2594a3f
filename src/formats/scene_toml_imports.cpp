#include "formats/scene_toml_imports.h"

#include <algorithm>

#include "core/error.h"
#include "formats/scene_toml.h"
#include "scene/dispersion.h"

namespace nephroid {
namespace {

constexpr Range kHalfAngle{0, 90};

// The element that a table is about.
template <class Element>
Element& named(TomlTable& table, const std::string& prefix, std::vector<Element>& all) {
  const std::string name = table.requiredText("name");
  const auto found = std::ranges::find(all, prefix + name, &Element::name);
  if (found != all.end()) return *found;
  std::vector<std::string> names;
  for (const Element& element : all)
    if (element.name.starts_with(prefix)) names.push_back(element.name.substr(prefix.size()));
  const std::string nearest = nearestName(name, names);
  table.fail("name", "is \"" + name + "\", which the file does not bring" +
                         (nearest.empty() ? "" : "; the nearest is \"" + nearest + "\""));
}

void readChange(TomlTable& table, Light& light) {
  if (light.type == LightType::directional)
    light.illuminance = table.numberOrRgb("illuminance", kNotNegative).value_or(light.illuminance);
  else
    light.intensity = table.numberOrRgb("intensity", kNotNegative).value_or(light.intensity);
  light.position = table.vector3("position").value_or(light.position);
  if (const auto direction = table.vector3("direction")) {
    if (!(length(*direction) > 0)) table.fail("direction", "gives no direction; its length must not be 0");
    light.direction = normalize(*direction);
  }
  if (light.type != LightType::spot) return;
  light.innerAngle =
      static_cast<float>(table.number("inner_angle", kHalfAngle).value_or(double(light.innerAngle)));
  light.outerAngle =
      static_cast<float>(table.number("outer_angle", kHalfAngle).value_or(double(light.outerAngle)));
  if (light.innerAngle > light.outerAngle) table.fail("inner_angle", "must not be above \"outer_angle\"");
}

void readChange(TomlTable& table, Object& object) {
  Placement& placement = object.placement;
  placement.translation = table.vector3("translation").value_or(placement.translation);
  if (const auto degrees = table.vector3("rotation")) placement.rotation = rotationOf(*degrees);
  placement.scale = static_cast<float>(table.number("scale", kPositive).value_or(double(placement.scale)));
}

void readChange(TomlTable& table, Material& material) {
  if (material.type != MaterialType::dielectric) {
    material.color = table.numberOrRgb("color", kFraction).value_or(material.color);
    return;
  }
  if (const auto ior = table.numberOrRgb("ior", kIor)) {
    material.ior = *ior;
    material.dispersion = 0;
  }
  if (const auto abbe = table.number("abbe", kAbbe))
    setDispersion(material, double(material.ior.y), 20 / *abbe);
  material.attenuationColor =
      table.vector3("attenuation_color", kFraction).value_or(material.attenuationColor);
  if (const auto distance = table.number("attenuation_distance", kPositive))
    material.attenuationDistance = static_cast<float>(*distance);
}

template <class Element>
void applyTo(std::vector<Element>& all, std::vector<TomlTable>& tables, const std::string& prefix) {
  for (TomlTable& table : tables) {
    readChange(table, named(table, prefix, all));
    table.finish();
  }
}

}  // namespace

ImportChanges importChanges(TomlTable& table) {
  return {table.tables("light"), table.tables("part"), table.tables("material")};
}

void applyImportChanges(ImportChanges changes, const std::string& prefix, Scene& scene) {
  applyTo(scene.lights, changes.lights, prefix);
  applyTo(scene.objects, changes.parts, prefix);
  applyTo(scene.materials, changes.materials, prefix);
}

}  // namespace nephroid
