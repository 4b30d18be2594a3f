#include "formats/scene_toml.h"

#include <sstream>

#include "core/error.h"
#include "formats/default_sky.h"
#include "formats/mesh_file.h"
#include "scene/framing.h"

namespace nephroid {
namespace {

constexpr std::uintmax_t kLargestSceneFile = std::uintmax_t{64} << 20;  // bytes
constexpr double kLargestSensor = 1 << 26;                              // texels

std::optional<TomlTable> section(const toml::table& root, TomlTable& top, const std::string& key,
                                 const std::string& file) {
  if (!top.has(key)) return std::nullopt;
  const toml::table* table = root.get_as<toml::table>(key);
  if (!table) top.fail(key, "must be written [" + key + "], once");
  return TomlTable(*table, file, "[" + key + "]");
}

// A number, or "auto", or from its exposure value.
std::optional<float> readExposure(TomlTable& table) {
  const bool hasValue = table.has("ev100");
  if (hasValue && table.has("exposure"))
    table.fail("ev100", "and \"exposure\" say the same; give one of them");
  if (hasValue) return float(exposureOfEv100(*table.number("ev100", {-kMostEv100, kMostEv100})));
  if (table.isText("exposure")) {
    if (*table.text("exposure") != kAutoExposure)
      table.fail("exposure", "must be a number or \"" + std::string(kAutoExposure) + "\"");
    return std::nullopt;
  }
  const auto number = table.number("exposure", {kLeastExposure, kMostExposure});
  return number ? std::optional(float(*number)) : std::nullopt;
}

ToneCurve readTone(TomlTable& table) {
  return ToneCurve(table.choice("tone", {kToneCurveNames.begin(), kToneCurveNames.end()}));
}

Camera readCamera(TomlTable table) {
  Camera camera;
  camera.position = table.requiredVector3("position");
  camera.target = table.vector3("target").value_or(camera.target);
  camera.verticalFov = static_cast<float>(table.number("fov", {0.01, 179}).value_or(camera.verticalFov));
  camera.exposure = readExposure(table);
  camera.tone = readTone(table);
  if (!(glm::distance(camera.position, camera.target) > 0)) {
    table.fail("position", "is the target as well; they must differ");
  }
  camera.up = table.vector3("up").value_or(upFor(camera.target - camera.position));
  if (!(glm::length(glm::cross(camera.up, camera.target - camera.position)) > 0))
    table.fail("up", "lies along the view; it must point to another side");
  table.finish();
  return camera;
}

Environment readEnvironment(TomlTable table) {
  Environment environment;
  environment.ambient = table.numberOrRgb("ambient", kNotNegative).value_or(environment.ambient);
  environment.background = table.numberOrRgb("background", kNotNegative).value_or(environment.background);
  table.finish();
  return environment;
}

void readSensors(std::vector<TomlTable> tables, Scene& scene) {
  for (TomlTable& table : tables) {
    Sensor sensor;
    table.requiredText("name");
    sensor.name = readName(table, scene.sensors, "");
    table.setName("[[sensor]] \"" + sensor.name + "\"");
    sensor.corner = table.requiredVector3("corner");
    sensor.u = table.requiredVector3("u");
    sensor.v = table.requiredVector3("v");
    const glm::dvec3 u = sensor.u, v = sensor.v;
    if (!(glm::length(glm::cross(v, u)) > 1e-6 * glm::length(u) * glm::length(v))) {
      table.fail("u", "and \"v\" span no area; they must be longer than 0 and not parallel");
    }
    const auto resolution = table.integers2("resolution", {1, kLargestSensorSide});
    sensor.resolution = resolution.value_or(sensor.resolution);
    if (static_cast<double>(sensor.resolution.x) * sensor.resolution.y > kLargestSensor) {
      table.fail("resolution", "is more than 2^26 texels; make it smaller");
    }
    table.finish();
    scene.sensors.push_back(sensor);
  }
}

}  // namespace

std::string readSceneFile(const std::filesystem::path& file) {
  return readFile(file, kLargestSceneFile);
}

Scene loadTomlScene(const std::filesystem::path& file, double time, WaveRuns* waves) {
  return readTomlScene(readSceneFile(file), file, time, waves);
}

Scene readTomlScene(const std::string& text, const std::filesystem::path& file, double time,
                    WaveRuns* waves) {
  const std::string name = oneLine(file.string());
  const toml::table root = parseToml(text, name);
  TomlTable top(root, name, "");
  Scene scene;
  scene.file = file;
  scene.time = time;
  auto camera = section(root, top, "camera", name);
  auto environment = section(root, top, "environment", name);
  auto medium = section(root, top, "medium", name);
  auto materials = top.tables("material");
  auto objects = top.tables("object");
  auto lights = top.tables("light");
  auto sensors = top.tables("sensor");
  top.finish();
  const bool isBackgroundGiven = environment && environment->has("background");
  if (environment) scene.environment = readEnvironment(*environment);
  if (medium) scene.medium = readMedium(*medium, file.parent_path());
  readMaterials(std::move(materials), scene);
  const std::optional<Camera> imported = readObjects(std::move(objects), scene, waves);
  readLights(std::move(lights), scene, isBackgroundGiven);
  readSensors(std::move(sensors), scene);
  scene.camera = camera ? readCamera(*camera) : imported ? *imported : framingCamera(scene);
  if (!top.has("light")) lightByDefault(scene, isBackgroundGiven);
  return scene;
}

}  // namespace nephroid
