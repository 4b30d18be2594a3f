#include <fstream>

#include "core/error.h"
#include "scene/scene_toml.h"

namespace nephroid {
namespace {

constexpr double kMostLineSamples = 4096;

vec3 unitDirection(TomlTable& table, vec3 direction, const char* key) {
  if (!(glm::length(direction) > 1e-9f)) table.fail(key, "gives no direction; its length must not be 0");
  return glm::normalize(direction);
}

void readSpot(TomlTable& table, Light& light, const Scene& scene) {
  light.position = table.requiredVector3("position");
  light.intensity = table.requiredNumberOrRgb("intensity", kNotNegative);
  const auto direction = table.vector3("direction"), target = table.vector3("target");
  if (direction.has_value() == target.has_value()) {
    table.fail("direction", "or \"target\" must be there for a spot, and not both");
  }
  light.direction = direction ? unitDirection(table, *direction, "direction")
                              : unitDirection(table, *target - light.position, "target");
  light.outerAngle = static_cast<float>(table.number("outer_angle", {0.01, 90}).value_or(light.outerAngle));
  light.innerAngle = static_cast<float>(table.number("inner_angle", {0, 90}).value_or(0));
  if (light.innerAngle > light.outerAngle) {
    table.fail("inner_angle", "is larger than \"outer_angle\"; it must not be");
  }
  for (const char* key : {"gobo", "ies"}) {
    const auto name = table.text(key);
    if (!name) continue;
    const auto path = scene.file.parent_path() / *name;
    if (!std::filesystem::exists(path))
      table.fail(key, "names \"" + path.string() + "\", which is not there");
    table.fail(key, "shapes the light, which this version does not do; take it out");
  }
}

void readLine(TomlTable& table, Light& light) {
  light.position = table.requiredVector3("from");
  light.end = table.requiredVector3("to");
  light.intensity = table.requiredNumberOrRgb("intensity", kNotNegative);
  light.samples =
      static_cast<uint32_t>(table.integer("samples", {1, kMostLineSamples}).value_or(light.samples));
  if (light.position == light.end) table.fail("to", "is where the line begins; its length must not be 0");
}

}  // namespace

void readLights(std::vector<TomlTable> tables, Scene& scene) {
  for (TomlTable& table : tables) {
    Light light;
    light.name = readName(table, scene.lights, "light " + std::to_string(scene.lights.size() + 1));
    if (!table.has("type")) table.requiredText("type");
    constexpr std::array kTypes{LightType::point, LightType::spot, LightType::directional, LightType::line};
    light.type = kTypes[table.choice("type", {"point", "spot", "directional", "line"})];
    switch (light.type) {
      case LightType::point:
        light.position = table.requiredVector3("position");
        light.intensity = table.requiredNumberOrRgb("intensity", kNotNegative);
        break;
      case LightType::spot:
        readSpot(table, light, scene);
        break;
      case LightType::directional:
        light.direction = unitDirection(table, table.requiredVector3("direction"), "direction");
        light.illuminance = table.requiredNumberOrRgb("illuminance", kNotNegative);
        break;
      case LightType::line:
        readLine(table, light);
        break;
    }
    table.finish();
    scene.lights.push_back(light);
  }
}

}  // namespace nephroid
