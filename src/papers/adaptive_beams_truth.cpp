#include "papers/adaptive_beams_truth.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "core/stopwatch.h"
#include "formats/load.h"
#include "geometry/bounds.h"
#include "papers/counted_truth.h"
#include "papers/frame_bench.h"
#include "papers/paper_scenes.h"
#include "reference/sensor.h"
#include "reference/settings.h"
#include "render/settings.h"
#include "techniques/adaptive_beams/landed_light.h"
#include "techniques/adaptive_beams/picture_mesh.h"
#include "techniques/registry.h"

namespace nephroid {
namespace {

constexpr int kReadings = 3;  // of which the median is told
constexpr float kUsualError = 0.01f;
constexpr const char* kSceneOfSensors = "ball-lamp";
constexpr std::array<uint32_t, 3> kSensors{64, 256, 1024};  // texels along a side
constexpr std::array<int, 3> kFloors{3, 20, 200};           // m

constexpr std::array<float, 4> kErrors{0.05f, 0.02f, 0.01f, 0.005f};  // asked for
constexpr std::array<const char*, 6> kCountedScenes{"ball-lamp", "ball-sun-past", "prism-sun",
                                                    "ring-sun",  "slab-lamp",     "wave-sun-past"};
// Without counts: beside the reference.
constexpr std::array<const char*, 2> kReferredScenes{"glass-ball", "paper5-pool"};
constexpr uint32_t kPassesBeside = 48;

TechniqueSettings settingsWithin(float error) {
  TechniqueSettings settings;
  settings.technique = "adaptive-beams";
  settings.own.of<Accuracy>().error = error;
  return settings;
}

struct Reading {
  SensorLayer lux;
  Stats stats;
  double milliseconds = 0;  // median
};

Reading readSensor(const Scene& scene, const Sensor& sensor, float error) {
  const TechniqueSettings settings = settingsWithin(error);
  const RayScene rays(scene);
  Reading reading;
  std::vector<double> milliseconds;
  for (int run = 0; run < kReadings; ++run) {
    Progress silent;
    reading.stats = {};
    const Stopwatch watch;
    reading.lux =
        techniqueNamed(settings.technique).measure({scene, rays, sensor, settings}, silent, reading.stats);
    milliseconds.push_back(watch.milliseconds());
  }
  reading.milliseconds = median(milliseconds);
  return reading;
}

void add(PaperTable& table, const std::string& row, const char* quantity, const char* unit, double value) {
  table.figures.push_back({row, quantity, unit, kNoFigure, value});
}

void addErrors(PaperTable& table, const std::string& row, const TruthErrors& errors, double spread) {
  add(table, row, "flux off", "%", 100 * (errors.fluxRatio - 1));
  add(table, row, "error", "%", 100 * errors.relativeRmse);
  add(table, row, "counts' spread", "%", 100 * spread);
  add(table, row, "without the worst", "%", 100 * errors.withoutWorst);
}

void addWork(PaperTable& table, const std::string& row, const Reading& reading) {
  add(table, row, "claimed", "%", 100 * reading.stats.error.value_or(kNoFigure));
  add(table, row, "rays", "", countOf(reading.stats, "rays"));
  add(table, row, "beams", "", countOf(reading.stats, "beams"));
  add(table, row, "time", "ms", reading.milliseconds);
}

void addSensor(PaperTable& table, const std::string& row, const Scene& scene, const CountedTruth& truth,
               uint32_t texels) {
  Sensor sensor = scene.sensors.at(0);
  const uint32_t counted = sensor.resolution.x;
  sensor.resolution = uvec2(texels);
  const Reading reading = readSensor(scene, sensor, kUsualError);
  // Both at the coarser of the two resolutions.
  const std::vector<float> lux = meansOfBlocks<float>(truth.lux, counted, std::max(counted / texels, 1u));
  addErrors(table, row,
            errorsAgainst(lux, meansOfBlocks<vec3>(reading.lux, texels, std::max(texels / counted, 1u))),
            texels < counted ? kNoFigure : truth.spread);
  addWork(table, row, reading);
}

// As it is drawn: the sensor's texels are looked up, at points of each, in the light of the whole picture.
SensorLayer lookedUp(const LandedLight& light, const Sensor& sensor) {
  constexpr uint32_t kPointsAlong = 4;  // a texel's side
  const uvec2 texels = sensor.resolution, points = texels * kPointsAlong;
  const vec3 normal = normalize(cross(sensor.v, sensor.u));
  SensorLayer lux(std::size_t(texels.x) * texels.y, vec3(0));
  for (uint32_t y = 0; y < points.y; ++y)
    for (uint32_t x = 0; x < points.x; ++x) {
      const vec2 place = (vec2(x, y) + 0.5f) / vec2(points);
      lux[std::size_t(y / kPointsAlong) * texels.x + x / kPointsAlong] +=
          light.illuminanceAt(sensor.corner + place.x * sensor.u + place.y * sensor.v, normal) /
          float(kPointsAlong * kPointsAlong);
    }
  return lux;
}

void addFloor(PaperTable& table, const std::string& row, Scene scene, const CountedTruth& truth, float side) {
  for (Object& object : scene.objects)
    if (!scene.isCaster(object)) {
      const Box box = boundingBox(scene.meshOf(object));
      object.placement.scale = side / (box.high.x - box.low.x);
    }
  const RayScene rays(scene);
  const RayMeshSettings wanted = settingsOfPicture(scene, RenderSettings{}.size, settingsWithin(kUsualError));
  RayMesh mesh;
  LandedLight light;
  std::vector<double> milliseconds;
  for (int run = 0; run < kReadings; ++run) {
    Progress silent;
    const Stopwatch watch;
    traceRayMesh(scene, rays, wanted, silent, mesh);
    light.build(mesh);
    milliseconds.push_back(watch.milliseconds());
  }
  Reading reading{lookedUp(light, scene.sensors.at(0)), {}, median(milliseconds)};
  reading.stats.error = mesh.stats.error;
  setCount(reading.stats, "rays", mesh.stats.rays);
  setCount(reading.stats, "beams", mesh.beams.size());
  addErrors(table, row, errorsAgainst(truth.lux, reading.lux), truth.spread);
  addWork(table, row, reading);
}

// lux that another program counted, or that the reference counts now.
struct Beside {
  std::string name;
  Scene scene;
  std::vector<float> lux;
  double spread = 0;
};

Beside besideReference(const std::filesystem::path& scenes, const std::string& name, Progress& progress) {
  Beside beside{name, loadScene(scenes / (name + ".toml")), {}, 0};
  const Sensor& sensor = beside.scene.sensors.at(0);
  const RayScene rays(beside.scene);
  ReferenceSensor reference(beside.scene, rays, sensor,
                            referenceSettingsOf({}, Paths::all, sensor.resolution));
  refine(reference, {.passes = kPassesBeside}, progress);
  const Image image = reference.image();
  beside.lux = *image.find("caustics.G");
  double sum = 0, variance = 0;
  for (const float lux : beside.lux) sum += double(lux);
  for (const float texel : *image.find("caustics.variance.G")) variance += double(texel);
  beside.spread = std::sqrt(variance * double(beside.lux.size())) / sum;
  return beside;
}

void addAsked(PaperTable& table, const Beside& beside, float error) {
  char row[64];
  std::snprintf(row, sizeof row, "%s, %g %%", beside.name.c_str(), double(100 * error));
  const Reading reading = readSensor(beside.scene, beside.scene.sensors.at(0), error);
  add(table, row, "asked", "%", 100 * double(error));
  addErrors(table, row, errorsAgainst(beside.lux, reading.lux), beside.spread);
  addWork(table, row, reading);
}

}  // namespace

PaperTable measureAdaptiveTruth(const PaperBench& bench, Progress& progress) {
  const std::vector<CountedTruth> truths = countedTruths(paperScenes(bench) / "truth");
  PaperTable table{
      "adaptive-beams-truth",
      "adaptive-beams against scenes/truth, all paths, --error 1%: sensors by `nephroid measure`, "
      "floors by the light of a picture of 640 x 480; medians of 3 runs",
      {}};
  progress.begin("scenes with counted light", truths.size());
  for (const CountedTruth& truth : truths) {
    const Scene scene = loadScene(truth.scene);
    const Reading reading = readSensor(scene, scene.sensors.at(0), kUsualError);
    addErrors(table, truth.name, errorsAgainst(truth.lux, reading.lux), truth.spread);
    addWork(table, truth.name, reading);
    progress.advance();
  }
  progress.finish();
  const auto ofSensors = std::ranges::find(truths, kSceneOfSensors, &CountedTruth::name);
  if (ofSensors == truths.end()) return table;
  const Scene scene = loadScene(ofSensors->scene);
  for (const uint32_t texels : kSensors)
    addSensor(table, std::string(kSceneOfSensors) + ", " + std::to_string(texels) + " squared", scene,
              *ofSensors, texels);
  for (const int side : kFloors)
    addFloor(table, std::string(kSceneOfSensors) + ", floor of " + std::to_string(side) + " m", scene,
             *ofSensors, float(side));
  return table;
}

PaperTable measureAdaptiveError(const PaperBench& bench, Progress& progress) {
  const std::filesystem::path scenes = paperScenes(bench);
  std::vector<Beside> all;
  for (CountedTruth& truth : countedTruths(scenes / "truth"))
    if (std::ranges::find(kCountedScenes, truth.name) != kCountedScenes.end())
      all.push_back({truth.name, loadScene(truth.scene), std::move(truth.lux), truth.spread});
  for (const char* name : kReferredScenes) all.push_back(besideReference(scenes, name, progress));
  PaperTable table{
      "adaptive-beams-error",
      "adaptive-beams by the error that is asked for, all paths: beside scenes/truth, and beside "
      "the reference of " +
          std::to_string(kPassesBeside) + " passes (glass-ball, paper5-pool); median of 3 runs",
      {}};
  progress.begin("errors asked for", all.size() * kErrors.size());
  for (const Beside& beside : all)
    for (const float error : kErrors) {
      addAsked(table, beside, error);
      progress.advance();
    }
  progress.finish();
  return table;
}

}  // namespace nephroid
