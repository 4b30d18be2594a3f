#include "viewer/scene_time.h"

#include <algorithm>

#include "scene/scene_toml.h"
#include "scene/shapes.h"

namespace nephroid {
namespace {

// Whether anything of a light is a list of [time, value].
bool hasCue(const toml::table& light) {
  return std::ranges::any_of(light, [](const auto& entry) {
    const toml::array* list = entry.second.as_array();
    return list && !list->empty() && list->front().is_array();
  });
}

// What was not changed by hand goes on.
template <class Value>
void follow(Value& value, Value& asLoaded, const Value& next) {
  if (value == asLoaded) value = next;
  asLoaded = next;
}

// A strength that was changed stays as many times as bright, as a file that it is saved in has it.
void followStrength(vec3& value, vec3& asLoaded, vec3 next) {
  for (int c = 0; c < 3; ++c)
    value[c] = asLoaded[c] > 0 ? value[c] / asLoaded[c] * next[c] : value[c] + next[c];
  asLoaded = next;
}

void follow(Light& light, Light& asLoaded, const Light& next) {
  follow(light.direction, asLoaded.direction, next.direction);
  follow(light.innerAngle, asLoaded.innerAngle, next.innerAngle);
  follow(light.outerAngle, asLoaded.outerAngle, next.outerAngle);
  follow(light.goboRotation, asLoaded.goboRotation, next.goboRotation);
  followStrength(light.intensity, asLoaded.intensity, next.intensity);
  followStrength(light.illuminance, asLoaded.illuminance, next.illuminance);
}

// Lights of the file are the last of the scene's, after those that were imported.
void moveLights(Scene& scene, SceneState& asLoaded, const std::string& text) {
  const toml::table root = parseToml(text, scene.file.string());
  const toml::array* tables = root.get_as<toml::array>("light");
  if (!tables || std::ranges::none_of(*tables, [](const toml::node& node) {
        return node.is_table() && hasCue(*node.as_table());
      }))
    return;
  Scene next;
  next.file = scene.file;
  next.time = scene.time;
  readLights(TomlTable(root, scene.file.string(), "").tables("light"), next);
  if (next.lights.size() > scene.lights.size()) return;
  const std::size_t first = scene.lights.size() - next.lights.size();
  for (std::size_t i = 0; i < next.lights.size(); ++i)
    follow(scene.lights[first + i], asLoaded.lights[first + i], next.lights[i]);
}

}  // namespace

void moveTo(Scene& scene, SceneState& asLoaded, const std::string& text, double time) {
  scene.time = time;
  if (!text.empty()) moveLights(scene, asLoaded, text);
  // A sequence of meshes has no grid, and stays as it was loaded.
  for (const Object& object : scene.objects)
    if (object.water && object.water->grid.x > 0) scene.meshes[object.mesh] = makeWater(*object.water, time);
}

}  // namespace nephroid
