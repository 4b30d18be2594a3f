#include "viewer/scene_time.h"

#include <algorithm>

#include "formats/scene_toml.h"
#include "geometry/shapes.h"
#include "water/water.h"

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
void follow(Value& value, const Value& was, const Value& is) {
  if (value == was) value = is;
}

// A strength that was changed stays as many times as bright, as a file that it is saved in has it.
void followStrength(vec3& value, vec3 was, vec3 is) {
  for (int c = 0; c < 3; ++c) value[c] = was[c] > 0 ? value[c] / was[c] * is[c] : value[c] + is[c];
}

// The file has the light as it `was`, and then as it `is`.
void follow(Light& light, const Light& was, const Light& is) {
  follow(light.direction, was.direction, is.direction);
  follow(light.innerAngle, was.innerAngle, is.innerAngle);
  follow(light.outerAngle, was.outerAngle, is.outerAngle);
  follow(light.radius, was.radius, is.radius);
  follow(light.angle, was.angle, is.angle);
  follow(light.goboRotation, was.goboRotation, is.goboRotation);
  follow(light.skyRotation, was.skyRotation, is.skyRotation);
  followStrength(light.intensity, was.intensity, is.intensity);
  followStrength(light.illuminance, was.illuminance, is.illuminance);
}

// While it stands, one scene has the files of another's lights, which need not be read again then.
class LentFiles {
 public:
  LentFiles(Scene& scene, Scene& other) : scene_(scene), other_(other) { exchange(); }
  LentFiles(const LentFiles&) = delete;
  LentFiles& operator=(const LentFiles&) = delete;
  ~LentFiles() { exchange(); }

 private:
  void exchange() {
    std::swap(scene_.textures, other_.textures);
    std::swap(scene_.profiles, other_.profiles);
    std::swap(scene_.skies, other_.skies);
  }
  Scene &scene_, &other_;
};

// Those that the file has at the scene's time, where any has a cue.
std::vector<Light> lightsOfFile(Scene& scene, const std::string& text) {
  const toml::table root = parseToml(text, scene.file.string());
  const toml::array* tables = root.get_as<toml::array>("light");
  if (!tables || std::ranges::none_of(*tables, [](const toml::node& node) {
        return node.is_table() && hasCue(*node.as_table());
      }))
    return {};
  Scene then;
  then.file = scene.file;
  then.time = scene.time;
  const LentFiles lent(scene, then);
  readLights(TomlTable(root, scene.file.string(), "").tables("light"), then, false);
  return then.lights;
}

void moveLights(Scene& scene, SceneState& asLoaded, History& history, const std::string& text) {
  const std::vector<Light> next = lightsOfFile(scene, text);
  if (next.size() > scene.lights.size()) return;
  // Lights of the file are the last of the scene's, after those that were imported.
  const std::size_t first = scene.lights.size() - next.size();
  const std::vector<Light> before = asLoaded.lights;
  const auto move = [&](std::vector<Light>& lights) {
    for (std::size_t i = 0; i < next.size(); ++i) follow(lights[first + i], before[first + i], next[i]);
  };
  move(scene.lights);
  move(asLoaded.lights);
  history.changeAll([&](SceneState& state) { move(state.lights); });
}

}  // namespace

void moveTo(Scene& scene, SceneState& asLoaded, History& history, const std::string& text, double time,
            WaveRuns& waves) {
  scene.time = time;
  if (!text.empty()) moveLights(scene, asLoaded, history, text);
  // A sequence of meshes stays as it was loaded.
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    const Object& object = scene.objects[i];
    if (takesStones(object)) scene.meshes[object.mesh] = makeWater(*object.water, time, &waves[i]);
  }
}

}  // namespace nephroid
