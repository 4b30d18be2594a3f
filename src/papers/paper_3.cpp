#include "papers/paper_3.h"

#include <algorithm>
#include <array>

#include "core/stopwatch.h"
#include "geometry/shapes.h"
#include "gpu/command_list.h"
#include "gpu/transfer.h"
#include "papers/frame_bench.h"
#include "papers/paper_3_errors.h"
#include "papers/paper_scenes.h"
#include "papers/volume_sensor.h"
#include "techniques/irradiance_volume/settings.h"
#include "techniques/registry.h"

namespace nephroid {
namespace {

constexpr FrameBench::Counts kCounts{.warmUps = 3, .frames = 15};
constexpr int kLookUps = 50;
constexpr uvec2 kPictureSize{360, 360};
constexpr double kFrameRatesAsked = 4;

// Wyman 2004, table 1: frames a second on 30 processors, seconds per light sample on one.
struct VolumeRow {
  const char* scene;
  double grid, shells, multiResolution, harmonics5, none, seconds;
};
constexpr std::array<VolumeRow, 6> kVolumeRows{{{"sphere", 15.2, 17.3, 15.0, 8.1, 26.9, 1.7},
                                                {"cube", 12.1, 12.6, 10.8, 6.1, 20.2, 2.4},
                                                {"prism", 12.7, 13.2, 11.0, 6.5, 20.3, 2.0},
                                                {"ring", 9.3, 9.5, 8.8, 5.2, 12.9, 1.3},
                                                {"room", 1.94, 2.01, 1.90, 1.48, 2.29, 4.5},
                                                {"bunny", 2.16, 2.30, 2.25, 1.80, 2.55, 25.0}}};

TechniqueSettings volumeSettings(Representation representation) {
  TechniqueSettings settings = papersSettings("irradiance-volume");
  settings.own.of<IrradianceVolumeSettings>().representation = representation;
  return settings;
}

// Frame rates do not depend on how many light directions there are; spherical harmonics need them all.
TechniqueSettings harmonicSettings(uint32_t order) {
  TechniqueSettings settings = volumeSettings(Representation::harmonics);
  auto& own = settings.own.of<IrradianceVolumeSettings>();
  own.harmonicOrder = order;
  own.lightLevel = 0;
  own.photons = 20;
  return settings;
}

double secondsPerLightSample(const Scene& scene) {
  IrradianceVolume volume = volumeOf(scene, {});
  const uint32_t last = volume.sampleCount() - 1;
  std::vector<double> seconds;
  for (const uint32_t sample : {0u, last / 2, last}) {
    const Stopwatch watch;
    volume.makeSample(sample);
    seconds.push_back(watch.seconds());
  }
  return median(seconds);
}

void addRates(PaperTable& table, const VolumeRow& row, const std::filesystem::path& folder,
              gpu::Device* device, Progress& progress) {
  const Scene scene = loadPaper3(folder, row.scene);
  const auto add = [&](const char* kept, const TechniqueSettings& settings, double paper) {
    if (!device) return;
    FrameBench frames(*device, scene, settings, {.size = kPictureSize}, progress);
    const double seconds = frames.seconds(kCounts, scene);
    const std::string what = std::string(row.scene) + ", " + kept;
    table.figures.push_back({what, "frame rate", "1/s", paper, 1 / seconds, kFrameRatesAsked * paper});
    if (techniqueNamed(settings.technique).traits.drawsCaustics)
      table.figures.push_back({what, "look-up", "ms", kNoFigure, frames.passMilliseconds({"caustics"})});
  };
  add("grid", volumeSettings(Representation::grid), row.grid);
  add("shells", volumeSettings(Representation::shells), row.shells);
  add("multi-resolution", volumeSettings(Representation::multiResolution), row.multiResolution);
  add("harmonics of order 5", harmonicSettings(5), row.harmonics5);
  add("no caustics", papersSettings("none"), row.none);
  table.figures.push_back({std::string(row.scene) + ", one light sample", "seconds", "s", row.seconds,
                           secondsPerLightSample(scene)});
}

gpu::Image imageOf(gpu::Device& device, const char* name, const std::vector<vec4>& texels) {
  gpu::Image image = gpu::createImage(device, name, {.width = kPictureSize.x, .height = kPictureSize.y});
  const auto bytes = std::as_bytes(std::span(texels));
  gpu::uploadImage(device, image, {{bytes.begin(), bytes.end()}});
  return image;
}

// As many points as a picture has, all over the scene's first sensor, in one light sample: a sphere of few
// triangles is no ball, and would be looked up in three.
double lookUpMilliseconds(gpu::Device& device, const Scene& scene, Progress& progress) {
  TechniqueSettings settings = volumeSettings(IrradianceVolumeSettings{}.representation);
  settings.own.of<IrradianceVolumeSettings>().lightInterpolation = LightInterpolation::nearest;
  const Sensor& sensor = scene.sensors[0];
  std::vector<vec4> points;
  for (uint32_t y = 0; y < kPictureSize.y; ++y)
    for (uint32_t x = 0; x < kPictureSize.x; ++x) {
      const vec2 at = (vec2(float(x), float(y)) + 0.5f) / vec2(kPictureSize);
      points.emplace_back(sensor.corner + at.x * sensor.u + at.y * sensor.v, 1);
    }
  const gpu::Image positions = imageOf(device, "points", points);
  const gpu::Image normals =
      imageOf(device, "normals", std::vector<vec4>(points.size(), vec4(sensor.normal(), 0)));
  const gpu::Image caustics = imageOf(device, "caustics", std::vector<vec4>(points.size(), vec4(0)));
  FrameBench frames(device, scene, settings, {.size = kPictureSize}, progress);
  frames.renderer().render(scene);
  std::vector<double> seconds;
  for (int frame = 0; frame < kCounts.warmUps + kLookUps; ++frame) {
    const Stopwatch watch;
    device.submitAndWait([&](gpu::CommandList& commands) {
      frames.technique().shade(commands, {&positions, &normals}, caustics);
    });
    if (frame >= kCounts.warmUps) seconds.push_back(watch.seconds());
  }
  return 1000 * *std::ranges::min_element(seconds);
}

// The sphere's look-up with few triangles and with many.
void addTriangles(PaperTable& table, const std::filesystem::path& folder, gpu::Device& device,
                  Progress& progress) {
  Scene scene = loadPaper3(folder, "sphere");
  for (const uint32_t triangles : {1000u, 1000000u}) {
    scene.meshes[casterOf(scene).mesh] = makeSphere(0.5f, {.vertices = triangles / 2});
    table.figures.push_back({"sphere of " + std::to_string(triangles) + " triangles", "look-up", "ms",
                             kNoFigure, lookUpMilliseconds(device, scene, progress)});
  }
}

}  // namespace

PaperTable measurePaper3(const PaperBench& bench, Progress& progress) {
  const std::filesystem::path folder = paperScenes(bench);
  BenchDevice device(bench);
  PaperTable table{"paper-3",
                   "Paper 3, table 1 and figure 11: 360 x 360 (theirs on 30 processors); errors are of the "
                   "illuminance on the floor, root mean square over its mean; " +
                       device.on,
                   {}};
  for (const VolumeRow& row : kVolumeRows) addRates(table, row, folder, device.orNone(), progress);
  if (gpu::Device* on = device.orNone()) {
    TechniqueSettings order15 = harmonicSettings(15);
    const Scene sphere = loadPaper3(folder, "sphere");
    FrameBench frames(*on, sphere, order15, {.size = kPictureSize}, progress);
    table.figures.push_back({"sphere, harmonics of order 15", "frame rate", "1/s", kNoFigure,
                             1 / frames.seconds(kCounts, sphere)});
    addTriangles(table, folder, *on, progress);
  }
  addMemoryErrors(table, folder, progress);
  addFluxes(table, folder);
  addMotionErrors(table, folder, progress);
  return table;
}

}  // namespace nephroid
