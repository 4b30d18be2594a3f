#include <algorithm>
#include <array>
#include <numbers>

#include "core/error.h"
#include "core/image_io.h"
#include "formats/ies.h"
#include "formats/scene_toml.h"
#include "formats/sky_file.h"
#include "lights/clear_sky.h"
#include "lights/emitters.h"
#include "lights/light_shape.h"
#include "lights/sky.h"

namespace nephroid {
namespace {

constexpr Range kSkySamples{2, 4096};
constexpr int64_t kDefaultSkySamples = 64;
constexpr const char* kGoboPrefix = "gobo ";  // no imported texture is taken for one
constexpr uint32_t kLargestGoboSide = 4096;   // pixels

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

// The file that `key` names, as an index into `loaded`, where its name stands after `prefix`; kNone without
// the key. Lights of one file share it.
template <class Named>
uint32_t loadShared(TomlTable& table, const char* key, const Scene& scene, std::vector<Named>& loaded,
                    Named (*load)(const std::filesystem::path&), const std::string& prefix = {}) {
  const auto name = table.text(key);
  if (!name) return kNone;
  const auto path = scene.file.parent_path() / *name;
  const std::string label = prefix + path.string();
  const auto there = std::ranges::find(loaded, label, &Named::name);
  if (there != loaded.end()) return static_cast<uint32_t>(there - loaded.begin());
  std::error_code error;
  if (!std::filesystem::exists(path, error))
    table.fail(key, "names \"" + path.string() + "\", which is not there");
  try {
    loaded.push_back(load(path));
    loaded.back().name = label;
  } catch (const InputError& wrong) {
    table.fail(key, std::string("is not to be used: ") + wrong.what());
  }
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

// Steradians, each counted by the part of the light that the cone's falloff leaves there.
float weightedSolidAngle(const Light& light) {
  const SpotCone cone = coneOf(light);
  const float width = 1 / cone.scale, cosOuter = -cone.offset * width;
  const float soft = std::min(width, 1 - cosOuter);
  return 2 * std::numbers::pi_v<float> * (soft * soft * soft / (3 * width * width) + 1 - cosOuter - soft);
}

// Another cone for the same lumens: the falloff keeps its shape.
void zoomTo(float outerAngle, Light& light) {
  const float before = weightedSolidAngle(light);
  light.innerAngle *= outerAngle / light.outerAngle;
  light.outerAngle = outerAngle;
  light.intensity *= before / weightedSolidAngle(light);
}

// As a moving head does: tilted about its horizontal axis (up is positive), then turned about +Y (to the
// left, as seen from above counterclockwise, is positive).
vec3 aimed(vec3 direction, float pan, float tilt) {
  const vec3 right = lightFrame(direction).right;
  return normalize(glm::angleAxis(glm::radians(pan), vec3(0, 1, 0)) *
                   (glm::angleAxis(glm::radians(tilt), right) * direction));
}

// What may change in the course of a cue.
void readCue(TomlTable& table, Light& light, double time) {
  const auto at = [&](const char* key, Range range, double byDefault) {
    return static_cast<float>(table.numberAt(key, range, time).value_or(byDefault));
  };
  constexpr Range kTurn{-36000, 36000};
  light.direction = aimed(light.direction, at("pan", kTurn, 0), at("tilt", kTurn, 0));
  light.goboRotation = at("gobo_rotation", kTurn, 0);
  if (table.has("gobo_rotation") && light.goboTexture == kNone)
    table.fail("gobo_rotation", "is there without a \"gobo\" to turn");
  const auto zoom = table.numberAt("zoom", {0.01, 89}, time);
  if (zoom && light.profile != kNone)
    table.fail("zoom", "does not go with \"ies\", whose angles are those that were measured");
  if (zoom) zoomTo(static_cast<float>(*zoom), light);
}

// Candela at the peak: given, those of the profile, or those of so many lumens in the cone.
vec3 spotIntensity(TomlTable& table, const Light& light, const Scene& scene) {
  const auto flux = table.numberOrRgb("flux", kNotNegative);  // lm
  if (!flux && light.profile != kNone && !table.has("intensity"))
    return vec3(scene.profiles[light.profile].peak);
  if (!flux) return table.requiredNumberOrRgb("intensity", kNotNegative);
  if (table.has("intensity")) table.fail("flux", "and \"intensity\" are both there; give one of them");
  if (light.profile != kNone) table.fail("flux", "does not go with \"ies\"; give \"intensity\", its peak");
  return *flux / weightedSolidAngle(light);
}

// m; of a ball. 0: a point.
float readRadius(TomlTable& table) {
  return static_cast<float>(table.number("radius", {0, 1e6}).value_or(0));
}

// Degrees that the light's disk is seen under.
float readAngle(TomlTable& table) {
  if (!table.isText("angle")) return static_cast<float>(table.number("angle", {0, kWidestAngle}).value_or(0));
  if (table.text("angle") != "sun") table.fail("angle", "must be a number of degrees, or \"sun\" for 0.53");
  return kSunAngle;
}

void readSpot(TomlTable& table, Light& light, Scene& scene) {
  light.position = table.requiredVector3("position");
  light.radius = readRadius(table);
  light.goboTexture = loadShared(table, "gobo", scene, scene.textures, loadGobo, kGoboPrefix);
  light.profile = loadShared(table, "ies", scene, scene.profiles, loadIes);
  const auto direction = table.vector3("direction"), target = table.vector3("target");
  if (direction.has_value() == target.has_value()) {
    table.fail("direction", "or \"target\" must be there for a spot, and not both");
  }
  light.direction = direction ? unitDirection(table, *direction, "direction")
                              : unitDirection(table, *target - light.position, "target");
  readCone(table, light);
  light.intensity = spotIntensity(table, light, scene);
  readCue(table, light, scene.time);
}

void readLine(TomlTable& table, Light& light) {
  light.position = table.requiredVector3("from");
  light.end = table.requiredVector3("to");
  light.intensity = table.requiredNumberOrRgb("intensity", kNotNegative);
  light.samples =
      static_cast<uint32_t>(table.integer("samples", {1, kMostLineSamples}).value_or(light.samples));
  if (light.position == light.end) table.fail("to", "is where the line begins; its length must not be 0");
}

void readArea(TomlTable& table, Light& light) {
  light.position = table.requiredVector3("corner");
  light.u = table.requiredVector3("u");
  light.v = table.requiredVector3("v");
  const vec3 across = cross(light.v, light.u);
  const float area = length(across);  // m2
  if (!(area > 1e-9f)) table.fail("v", "and \"u\" span no area; they must not be 0 or in one line");
  light.direction = across / area;
  const auto flux = table.numberOrRgb("flux", kNotNegative);  // lm
  if (flux && table.has("luminance"))
    table.fail("flux", "and \"luminance\" are both there; give one of them");
  light.intensity =
      flux ? *flux / std::numbers::pi_v<float> : area * table.requiredNumberOrRgb("luminance", kNotNegative);
  light.grid = table.integers2("samples", {1, kMostAreaSamples}).value_or(light.grid);
}

void readEvenOrMappedSky(TomlTable& table, Light& light, Scene& scene) {
  for (const char* key : {"sun", "turbidity", "ground"})
    if (table.has(key)) table.fail(key, "goes with model = \"clear\" alone");
  light.skyMap = loadShared(table, "map", scene, scene.skies, loadSky);
  if (light.skyMap == kNone) {
    if (!table.has("luminance")) table.fail("luminance", "or \"map\" or \"model\" must be there for a sky");
    const SkyMap even = evenSky();
    const auto there = std::ranges::find(scene.skies, even.name, &SkyMap::name);
    light.skyMap = static_cast<uint32_t>(there - scene.skies.begin());
    if (there == scene.skies.end()) scene.skies.push_back(even);
  }
  light.sky = skyParts(scene.skies[light.skyMap], light.samples);
}

// Returns its sun.
Light readClearSky(TomlTable& table, Light& light, Scene& scene) {
  table.choice("model", {"clear"});
  if (table.has("map")) table.fail("map", "and \"model\" are both there; give one of them");
  ClearSky clear;
  const auto sun = table.vector2("sun");
  if (!sun) table.fail("sun", "must be there for model = \"clear\": [azimuth, elevation] in degrees");
  if (!(std::abs(sun->x) <= 360)) table.fail("sun", "must have an azimuth from -360 to 360 degrees");
  if (!(sun->y >= 0 && sun->y <= 90)) table.fail("sun", "must have an elevation from 0 to 90 degrees");
  clear.azimuth = sun->x;
  clear.elevation = sun->y;
  clear.turbidity = static_cast<float>(
      table.number("turbidity", {kLowestTurbidity, kHighestTurbidity}).value_or(clear.turbidity));
  clear.ground = table.numberOrRgb("ground", kFraction).value_or(clear.ground);
  return makeClearSky(clear, scene, light);
}

// Returns its sun, where it has one.
std::optional<Light> readSky(TomlTable& table, Light& light, Scene& scene, bool isBackgroundGiven) {
  light.intensity = table.numberOrRgb("luminance", kNotNegative).value_or(vec3(1));
  light.skyRotation = static_cast<float>(table.numberAt("rotation", {-36000, 36000}, scene.time).value_or(0));
  light.hasGivenSamples = table.has("samples");
  light.samples = static_cast<uint32_t>(table.integer("samples", kSkySamples).value_or(kDefaultSkySamples));
  light.isSeen = table.boolean("visible").value_or(!isBackgroundGiven);
  if (table.has("model")) return readClearSky(table, light, scene);
  readEvenOrMappedSky(table, light, scene);
  return std::nullopt;
}

}  // namespace

void readLights(std::vector<TomlTable> tables, Scene& scene, bool isBackgroundGiven) {
  const std::size_t first = scene.lights.size();
  std::vector<std::pair<std::size_t, Light>> suns;  // of which light
  for (TomlTable& table : tables) {
    Light light;
    light.name = readName(table, scene.lights, "light " + std::to_string(scene.lights.size() + 1));
    if (!table.has("type")) table.requiredText("type");
    constexpr std::array kTypes{LightType::point, LightType::spot, LightType::directional,
                                LightType::line,  LightType::area, LightType::sky};
    light.type = kTypes[table.choice("type", {"point", "spot", "directional", "line", "area", "sky"})];
    switch (light.type) {
      case LightType::point:
        light.position = table.requiredVector3("position");
        light.intensity = table.requiredNumberOrRgb("intensity", kNotNegative);
        light.radius = readRadius(table);
        break;
      case LightType::spot:
        readSpot(table, light, scene);
        break;
      case LightType::directional:
        light.direction = unitDirection(table, table.requiredVector3("direction"), "direction");
        light.illuminance = table.requiredNumberOrRgb("illuminance", kNotNegative);
        light.angle = readAngle(table);
        break;
      case LightType::line:
        readLine(table, light);
        break;
      case LightType::area:
        readArea(table, light);
        break;
      case LightType::sky:
        if (auto sun = readSky(table, light, scene, isBackgroundGiven))
          suns.emplace_back(scene.lights.size(), std::move(*sun));
        break;
    }
    const auto dimmer = static_cast<float>(table.numberAt("dimmer", {0, 1e6}, scene.time).value_or(1));
    light.intensity *= dimmer;
    light.illuminance *= dimmer;
    if (!suns.empty() && suns.back().first == scene.lights.size()) suns.back().second.illuminance *= dimmer;
    table.finish();
    scene.lights.push_back(light);
  }
  // Before the tables' lights, so that these are the last ones, in their order.
  for (std::size_t i = 0; i < suns.size(); ++i) {
    scene.lights[i + suns[i].first].sun = static_cast<uint32_t>(first + i);
    scene.lights.insert(scene.lights.begin() + static_cast<std::ptrdiff_t>(first + i), suns[i].second);
  }
}

}  // namespace nephroid
