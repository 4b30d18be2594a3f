#include <array>

#include "core/error.h"
#include "core/image_io.h"
#include "scene/ies.h"
#include "scene/scene_toml.h"

namespace nephroid {
namespace {

constexpr double kMostLineSamples = 4096;
constexpr uint32_t kLargestGoboSide = 4096;  // pixels

// What is not covered is dark, so alpha counts as black.
Texture loadGobo(const std::filesystem::path& file) {
  const ByteImage image = readPng(file, kLargestGoboSide);
  std::array<float, 256> linear;
  for (std::size_t i = 0; i < linear.size(); ++i) linear[i] = linearFromSrgb(float(i) / 255);
  Texture gobo{file.string(), image.width, image.height, {}};
  gobo.texels.reserve(std::size_t{image.width} * image.height);
  for (std::size_t i = 0; i < image.bytes.size(); i += 4) {
    const uint8_t* pixel = image.bytes.data() + i;
    const float alpha = float(pixel[3]) / 255;
    gobo.texels.emplace_back(alpha * vec3(linear[pixel[0]], linear[pixel[1]], linear[pixel[2]]), 1);
  }
  return gobo;
}

// The file that `key` names, as an index into `loaded`; kNone without the key. Lights of one file share it.
template <class Named>
uint32_t loadShared(TomlTable& table, const char* key, const Scene& scene, uint32_t Light::*index,
                    std::vector<Named>& loaded, Named (*load)(const std::filesystem::path&)) {
  const auto name = table.text(key);
  if (!name) return kNone;
  const auto path = scene.file.parent_path() / *name;
  std::error_code error;
  if (!std::filesystem::exists(path, error))
    table.fail(key, "names \"" + path.string() + "\", which is not there");
  for (const Light& other : scene.lights)
    if (other.*index != kNone && loaded[other.*index].name == path.string()) return other.*index;
  loaded.push_back(load(path));
  return static_cast<uint32_t>(loaded.size() - 1);
}

vec3 unitDirection(TomlTable& table, vec3 direction, const char* key) {
  if (!(glm::length(direction) > 1e-9f)) table.fail(key, "gives no direction; its length must not be 0");
  return glm::normalize(direction);
}

void readCone(TomlTable& table, Light& light) {
  const bool hasAngles = table.has("outer_angle") || table.has("inner_angle");
  if (light.profile != kNone && light.goboTexture == kNone && !hasAngles) {
    light.innerAngle = light.outerAngle = 180;  // the profile alone shapes it
    return;
  }
  light.outerAngle = static_cast<float>(table.number("outer_angle", {0.01, 90}).value_or(light.outerAngle));
  light.innerAngle = static_cast<float>(table.number("inner_angle", {0, 90}).value_or(0));
  if (light.innerAngle > light.outerAngle) {
    table.fail("inner_angle", "is larger than \"outer_angle\"; it must not be");
  }
  if (light.goboTexture != kNone && light.outerAngle >= 90) {
    table.fail("outer_angle", "is 90; with a \"gobo\", whose image fills the cone, it must be less");
  }
}

void readSpot(TomlTable& table, Light& light, Scene& scene) {
  light.position = table.requiredVector3("position");
  light.goboTexture = loadShared(table, "gobo", scene, &Light::goboTexture, scene.textures, loadGobo);
  light.profile = loadShared(table, "ies", scene, &Light::profile, scene.profiles, loadIes);
  light.intensity = light.profile == kNone || table.has("intensity")
                        ? table.requiredNumberOrRgb("intensity", kNotNegative)
                        : vec3(scene.profiles[light.profile].peak);
  const auto direction = table.vector3("direction"), target = table.vector3("target");
  if (direction.has_value() == target.has_value()) {
    table.fail("direction", "or \"target\" must be there for a spot, and not both");
  }
  light.direction = direction ? unitDirection(table, *direction, "direction")
                              : unitDirection(table, *target - light.position, "target");
  readCone(table, light);
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
