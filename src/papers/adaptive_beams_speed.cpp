#include "papers/adaptive_beams_speed.h"

#include <algorithm>
#include <array>
#include <limits>
#include <memory>

#include "core/error.h"
#include "core/stopwatch.h"
#include "formats/load.h"
#include "papers/frame_bench.h"
#include "papers/paper_scenes.h"
#include "techniques/adaptive_beams/picture_mesh.h"

namespace nephroid {
namespace {

constexpr std::array<const char*, 5> kTimedScenes{"glass-ball", "glass-teapot", "coloured-horse",
                                                  "glass-bunny", "paper5-pool"};
constexpr std::array<const char*, 3> kOlder{"illumination-textures", "sliced-images", "light-volumes"};
constexpr int kTimedFrames = 5;  // after one that makes images and programs
constexpr int kReplays = 3;
constexpr float kTurnOfFrame = 0.5f;  // degrees, of lights about the axis y through the origin

Scene withTurnedLights(Scene scene, int frame) {
  const quat turn = glm::angleAxis(glm::radians(kTurnOfFrame * float(frame)), vec3(0, 1, 0));
  for (Light& light : scene.lights) {
    light.position = turn * light.position;
    light.end = turn * light.end;
    light.direction = turn * light.direction;
  }
  return scene;
}

TechniqueSettings settingsOf(const char* technique) {
  TechniqueSettings settings;
  settings.technique = technique;
  settings.transport.source = Source::traced;
  settings.transport.paths = Paths::all;
  return settings;
}

// A technique with a device of its own, so that memory is its own too.
struct Contender {
  Contender(const PaperBench& bench, const char* technique, const Scene& scene, Progress& progress)
      : settings(settingsOf(technique)),
        device({.device = bench.device}),
        frames(device, scene, settings, {}, progress) {}

  // What a frame does until receivers have their light; light volumes find their beams while they look up.
  double litMilliseconds() const {
    return frames.lightMilliseconds() + frames.passMilliseconds({"beams on patches", "caustics"});
  }
  // Of one frame's light.
  uint64_t rays() {
    const uint64_t before = raysTraced();
    frames.technique().update(frames.renderer().gpuScene());
    return raysTraced() - before;
  }

  TechniqueSettings settings;
  gpu::Device device;
  FrameBench frames;
};

// The rays between boundaries of the mesh of rays for this scene's picture, in the order they were traced.
std::vector<Ray> raysOfPicture(const Scene& scene, const RayScene& rayScene) {
  RayMesh mesh;
  Progress silent;
  traceRayMesh(scene, rayScene, settingsOfPicture(scene, RenderSettings{}.size, settingsOf("adaptive-beams")),
               silent, mesh);
  std::vector<Ray> rays;
  for (const PathNode& node : mesh.nodes) {
    if (node.parent == kNone) continue;
    const PathNode& from = mesh.nodes[node.parent];
    rays.push_back({from.flatPosition, node.direction,
                    rayScene.clearance(from.object, from.geometricNormal, node.direction)});
  }
  return rays;
}

// Rays a second of Embree alone.
double bareRate(const Scene& scene) {
  const RayScene rayScene(scene);
  const std::vector<Ray> rays = raysOfPicture(scene, rayScene);
  std::vector<double> seconds;
  for (int run = 0; run < kReplays; ++run) {
    const Stopwatch watch;
    rayScene.replay(rays);
    seconds.push_back(watch.seconds());
  }
  return double(rays.size()) / median(seconds);
}

void addRow(PaperTable& table, const std::string& row, Contender& contender, double bare) {
  const auto add = [&](const char* quantity, const char* unit, double value) {
    table.figures.push_back({row, quantity, unit, kNoFigure, value});
  };
  const FrameBench& frames = contender.frames;
  const double light = frames.lightMilliseconds();
  const double beams = frames.passMilliseconds({"beams"});
  add("light", "ms", light);
  add("light looked up", "ms", contender.litMilliseconds());
  add("frame", "ms", 1000 * frames.seconds());
  add("device memory", "MB", double(contender.device.memoryBytes()) / 1e6);
  const double rays = double(contender.rays());
  add("rays", "", rays);
  add("rays in a second", "millions", rays / beams / 1000);
  add("of bare Embree's", "%", 100 * rays / beams * 1000 / bare);
}

using Contenders = std::vector<std::unique_ptr<Contender>>;

// Adds a technique whose memory the device has; says in `left` where it has not, as older ones may ask for
// gigabytes.
void addContender(Contenders& all, const char* technique, const std::string& name, const Scene& scene,
                  const PaperBench& bench, std::string& left, Progress& progress) {
  try {
    auto contender = std::make_unique<Contender>(bench, technique, scene, progress);
    contender->frames.warmUp(scene);
    all.push_back(std::move(contender));
  } catch (const RuntimeFailure& failure) {
    left += "; left out: " + name + ", " + technique + " (" + failure.what() + ")";
  }
}

// A frame of each, in turns. What runs out of memory on the way is left out, and said to be.
void timeAll(Contenders& all, const std::string& name, const Scene& scene, std::string& left) {
  std::erase_if(all, [&](const auto& contender) {
    try {
      contender->frames.time(scene);
      return false;
    } catch (const RuntimeFailure& failure) {
      left += "; left out: " + name + ", " + contender->settings.technique + " (" + failure.what() + ")";
      return true;
    }
  });
}

// Those that one frame shows to be far from the fastest are not timed further: some take seconds.
void dropSlow(Contenders& older, const std::string& name, const Scene& scene, std::string& left) {
  constexpr double kFar = 2;
  timeAll(older, name, scene, left);
  double least = std::numeric_limits<double>::infinity();
  for (const auto& contender : older) least = std::min(least, contender->litMilliseconds());
  std::erase_if(older, [&](const auto& contender) { return contender->litMilliseconds() > kFar * least; });
}

void addScene(PaperTable& table, const std::string& name, const Scene& scene, const PaperBench& bench,
              std::string& left, Progress& progress) {
  Contenders own, older;
  addContender(own, "adaptive-beams", name, scene, bench, left, progress);
  for (const char* technique : kOlder) addContender(older, technique, name, scene, bench, left, progress);
  dropSlow(older, name, scene, left);
  progress.begin("frames of " + name, kTimedFrames);
  for (int frame = 1; frame <= kTimedFrames; ++frame) {
    const Scene moved = withTurnedLights(scene, frame);
    // In turns, so that all meet the same machine.
    for (Contenders* some : {&own, &older}) timeAll(*some, name, moved, left);
    progress.advance();
  }
  progress.finish();
  const double bare = bareRate(scene);
  for (const auto& contender : own) addRow(table, name, *contender, bare);
  const auto best = std::ranges::min_element(older, {}, [](const auto& c) { return c->litMilliseconds(); });
  if (best != older.end()) addRow(table, name + ", " + (*best)->settings.technique, **best, bare);
}

}  // namespace

PaperTable measureAdaptiveSpeed(const PaperBench& bench, Progress& progress) {
  const std::filesystem::path folder = paperScenes(bench);
  std::vector<std::pair<std::string, Scene>> scenes;
  std::string left;
  for (const char* name : kTimedScenes) {
    const std::filesystem::path file = folder / (std::string(name) + ".toml");
    try {
      scenes.emplace_back(name, loadScene(file));
    } catch (const InputError& missing) {
      if (!std::filesystem::exists(file)) throw;
      left += std::string("; left out: ") + missing.what();  // a model that is not installed
    }
  }
  const BenchDevice device(bench);
  PaperTable table{"adaptive-beams-speed",
                   "adaptive-beams beside the fastest of the older techniques (--source traced --paths all), "
                   "in turns: 640 x 480, lights turn by half a degree a frame, medians of " +
                       std::to_string(kTimedFrames) + " frames; " + device.on,
                   {}};
  if (device.device)
    for (const auto& [name, scene] : scenes) addScene(table, name, scene, bench, left, progress);
  table.title += left;
  return table;
}

}  // namespace nephroid
