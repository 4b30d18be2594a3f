#include "papers/paper_5.h"

#include <algorithm>
#include <array>

#include "formats/load.h"
#include "geometry/shapes.h"
#include "papers/frame_bench.h"
#include "papers/paper_scenes.h"
#include "scene/framing.h"
#include "techniques/light_volumes/settings.h"
#include "water/water.h"

namespace nephroid {
namespace {

// Barczak and Olano, table 1 (what the hierarchy gains, %) and table 2 (frames a second without and with
// shadow culling, and with the exact cosine as well), for water of 120, 160 and 200 squared.
struct Pool {
  const char* figure;
  const char* scene;
  std::array<double, 3> gain;
  std::array<double, 3> hierarchical;
  std::array<double, 3> shadowCulling;
  std::array<double, 3> vectors;
};
constexpr std::array<Pool, 4> kPools{{
    {"1, left",
     "paper5-pool",
     {63.35, 79.50, 85.44},
     {6.85, 4.89, 3.58},
     {7.33, 5.40, 4.00},
     {5.58, 4.26, 3.27}},
    {"1, center",
     "paper5-treasure",
     {36.52, 49.89, 55.38},
     {11.98, 7.98, 5.17},
     {13.34, 9.32, 6.05},
     {11.48, 8.51, 5.81}},
    {"1, right",
     "paper5-slats",
     {112.26, 134.81, 143.31},
     {5.86, 3.50, 2.25},
     {6.55, 4.07, 2.59},
     {6.34, 4.00, 2.54}},
    {"3",
     "paper5-diver",
     {21.3, 32.41, 37.22},
     {12.55, 9.39, 6.46},
     {14.98, 11.50, 7.90},
     {11.64, 9.44, 7.24}},
}};
constexpr std::array<uint32_t, 3> kGrids{120, 160, 200};

constexpr FrameBench::Counts kCountsOfPools{.warmUps = 1, .frames = 2};
constexpr uvec2 kPoolSize(1024, 768);
// Every beam asked for every block of pixels is too slow for whole pictures, and for many of them.
constexpr uvec2 kSizeOfGain(128, 96);
constexpr FrameBench::Counts kCountsOfFlat{.warmUps = 1, .frames = 1};

Scene withGrid(Scene scene, uint32_t grid) {
  for (Object& object : scene.objects) {
    if (!object.water) continue;
    object.water->grid = uvec2(grid);
    scene.meshes[object.mesh] = makeWater(*object.water, 0);
  }
  return scene;
}

// With what stands above the water far off, so that all of it is lit.
Scene withoutOccluders(Scene scene) {
  for (Object& object : scene.objects)
    if (!scene.isCaster(object) && worldBounds(scene, object).low.y > 0)
      object.placement.translation.x += 100;
  return scene;
}

struct Timed {
  double seconds = 0;
  Stats stats;
};

// Of frames in which the water moves.
Timed timeFrames(FrameBench& frames, Scene scene, FrameBench::Counts counts) {
  const double seconds = frames.seconds(counts, [&](int frame) {
    for (const Object& object : scene.objects)
      if (object.water) scene.meshes[object.mesh] = makeWater(*object.water, frame / 60.0);
    return scene;
  });
  return {seconds, frames.stats()};
}

Timed timeFrames(gpu::Device& device, const Scene& scene, const TechniqueSettings& settings, uvec2 size,
                 FrameBench::Counts counts, Progress& progress) {
  FrameBench frames(device, scene, settings, {.size = size}, progress);
  return timeFrames(frames, scene, counts);
}

void addRow(PaperTable& table, const Pool& view, std::size_t grid, const Scene& start, gpu::Device& device,
            Progress& progress) {
  const Scene scene = withGrid(start, kGrids[grid]);
  const std::string name = std::string("figure ") + view.figure + " " + view.scene + ", " +
                           std::to_string(kGrids[grid]) + " squared";
  TechniqueSettings exact = papersSettings("light-volumes");
  exact.transport.source = Source::traced;
  TechniqueSettings still = exact, flat = exact;
  still.own.of<LightVolumeSettings>().cosine = Cosine::stillWater;
  flat.own.of<LightVolumeSettings>().culling = Culling::flat;
  const auto add = [&](const char* quantity, const char* unit, double paper, double ours, double asked) {
    table.figures.push_back({name, quantity, unit, paper, ours, asked});
  };
  FrameBench frames(device, scene, still, {.size = kPoolSize}, progress);
  const Timed ofShaded = timeFrames(frames, scene, kCountsOfPools);
  const Timed ofAll = timeFrames(frames, withoutOccluders(scene), kCountsOfPools);
  const Timed ofExact = timeFrames(device, scene, exact, kPoolSize, kCountsOfPools, progress);
  add("all of the water lit", "1/s", view.hierarchical[grid], 1 / ofAll.seconds, view.hierarchical[grid]);
  add("shadow culling", "1/s", view.shadowCulling[grid], 1 / ofShaded.seconds, view.shadowCulling[grid]);
  add("shadow culling's gain", "%", 100 * (view.shadowCulling[grid] / view.hierarchical[grid] - 1),
      100 * (ofAll.seconds / ofShaded.seconds - 1), kNoFigure);
  add("exact cosine", "1/s", view.vectors[grid], 1 / ofExact.seconds, view.vectors[grid]);
  const double few = timeFrames(device, scene, exact, kSizeOfGain, kCountsOfPools, progress).seconds;
  const double all = timeFrames(device, scene, flat, kSizeOfGain, kCountsOfFlat, progress).seconds;
  add("hierarchy's gain", "%", view.gain[grid], 100 * (all / few - 1), view.gain[grid]);
  add("volumes without occluders", "", kNoFigure, countOf(ofAll.stats, "light_volumes"), kNoFigure);
  const Stats& stats = ofExact.stats;
  add("volumes", "", kNoFigure, countOf(stats, "light_volumes"), kNoFigure);
  add("tests", "", kNoFigure, countOf(stats, "bounds_tested"), kNoFigure);
  add("culled", "", kNoFigure, countOf(stats, "bounds_culled"), kNoFigure);
  add("drawn", "", kNoFigure, countOf(stats, "volumes_drawn"), kNoFigure);
}

}  // namespace

PaperTable measurePaper5(const PaperBench& bench, Progress& progress) {
  const std::filesystem::path folder = paperScenes(bench);
  std::vector<Scene> scenes;  // errors in a scene are reported before anything is measured
  for (const Pool& view : kPools) scenes.push_back(loadScene(folder / (std::string(view.scene) + ".toml")));
  gpu::Device device({.device = bench.device});
  PaperTable table{
      "paper-5",
      "Paper 5, tables 1 and 2: 1024 x 768, moving water (the hierarchy's gain: whole frames of 128 x "
      "96, against all beams asked for every block of pixels); on " +
          device.info().name,
      {}};
  progress.begin("paper 5", kPools.size() * kGrids.size());
  for (std::size_t i = 0; i < kPools.size(); ++i)
    for (std::size_t grid = 0; grid < kGrids.size(); ++grid) {
      addRow(table, kPools[i], grid, scenes[i], device, progress);
      progress.advance();
    }
  progress.finish();
  return table;
}

}  // namespace nephroid
