#include "papers/papers_1_2.h"

#include <array>

#include "formats/load.h"
#include "papers/frame_bench.h"
#include "papers/paper_scenes.h"
#include "papers/table_times.h"

namespace nephroid {
namespace {

struct Row {
  const char* paper;
  const char* figure;
  const char* scene;
  double vertices;
  double megabytes;  // of the light transport table
  double hours;      // of preprocessing
  double framesPerSecond;
  double timesAsked;  // of that frame rate
  uint32_t slices;
};

// Iwasaki 2005, table 1 and section 7; Iwasaki 2005b, section 5, which gives neither sizes nor times of its
// tables.
constexpr std::array<Row, 14> kRows{{
    {"1", "8 (a)", "glass-ball", 6400, 10.6, 1.2, 5.1, 2, 6},
    {"1", "8 (b)", "glass-torus", 6400, 10.6, 1.2, 5.3, 2, 6},
    {"1", "9 (a)", "torus-knot", 13000, 21.4, 5.1, 2.8, 2, 6},
    {"1", "9 (b)", "glass-teapot", 12800, 21.1, 4.0, 3.0, 2, 6},
    {"1", "10 (a)", "knot-spotlight", 6400, 10.6, 1.2, 5.5, 2, 1},
    {"1", "10 (b)", "teapot-three-lights", 12800, 21.1, 4.0, 1.0, 2, 6},
    {"1", "10 (c)", "bunny-line-light", 8900, 11.6, 1.9, 1.3, 2, 6},
    {"1", "11 (a)", "coloured-horse", 8900, 11.6, 1.9, 3.6, 2, 6},
    {"1", "11 (b)", "coloured-bunny", 5100, 8.4, 1.0, 7.1, 2, 6},
    {"2", "1", "ball-over-teapot", 6400, kNoFigure, kNoFigure, 18, 1, 1},
    {"2", "6 (a)", "coloured-ball-over-statue", 6400, kNoFigure, kNoFigure, 7.8, 1, 6},
    {"2", "6 (b)", "ball-over-statue-in-room", 6400, kNoFigure, kNoFigure, 7.8, 1, 6},
    {"2", "6 (c)", "teapot-over-statue", 13000, kNoFigure, kNoFigure, 6.6, 1, 6},
    {"2", "6 (d)", "bunny-line-light-over-statue", 8900, kNoFigure, kNoFigure, 3.6, 1, 6},
}};

constexpr double kPreparationAsked = 5000;  // preprocessing
constexpr FrameBench::Counts kCountsOfRows{.warmUps = 2, .frames = 15};

// Turned about the axis y through the origin, then moved.
struct Motion {
  quat turn{1, 0, 0, 0};
  vec3 step{0};  // m
  vec3 point(vec3 p) const { return turn * p + step; }
};

Motion motion(float degrees, vec3 step) {
  return {glm::angleAxis(glm::radians(degrees), vec3(0, 1, 0)), step};
}

// Light, casters, receivers and camera, each on a way of its own.
Scene moved(const Scene& start, int frame) {
  const auto k = static_cast<float>(frame);
  const Motion ofReceivers = motion(0.4f * k, {0, 0, 0.002f * k}),
               ofCasters = motion(-0.7f * k, {0.003f * k, 0, 0}),
               ofLights = motion(0.9f * k, {0, 0.004f * k, 0}),
               ofCamera = motion(-0.5f * k, {0, 0.002f * k, 0});
  Scene scene = start;
  for (Object& object : scene.objects) {
    const Motion& way = scene.isCaster(object) ? ofCasters : ofReceivers;
    object.placement.translation = way.point(object.placement.translation);
    object.placement.rotation = normalize(way.turn * object.placement.rotation);
  }
  for (Light& light : scene.lights) {
    light.position = ofLights.point(light.position);
    light.end = ofLights.point(light.end);
    light.direction = ofLights.turn * light.direction;
  }
  scene.camera.position = ofCamera.point(scene.camera.position);
  return scene;
}

double framesPerSecond(gpu::Device& device, const Scene& scene, const Row& row, Progress& progress) {
  RenderSettings render;
  render.sight.method = SightMethod::slices;
  render.sight.slices = row.slices;
  FrameBench bench(device, scene, {}, render, progress);
  progress.begin(std::string("frames of ") + row.scene,
                 uint64_t(kCountsOfRows.warmUps + kCountsOfRows.frames));
  const double seconds = bench.seconds(kCountsOfRows, [&](int frame) {
    progress.advance();
    return moved(scene, frame);
  });
  progress.finish();
  return 1 / seconds;
}

void addRow(PaperTable& table, const Row& row, const Scene& scene, gpu::Device* device, Progress& progress) {
  const TableTimes tables = timeTables(scene, progress);
  const std::string name = std::string("paper ") + row.paper + ", " + row.figure + " " + row.scene;
  table.figures.push_back({name, "vertices", "", row.vertices, double(tables.vertices)});
  table.figures.push_back({name, "table size", "MB", row.megabytes, double(tables.bytes) / 1e6});
  const double paperSeconds = row.hours * 3600;
  table.figures.push_back(
      {name, "preprocessing", "s", paperSeconds, tables.seconds, paperSeconds / kPreparationAsked, true});
  table.figures.push_back({name, "frame rate", "1/s", row.framesPerSecond,
                           device ? framesPerSecond(*device, scene, row, progress) : kNoFigure,
                           row.timesAsked * row.framesPerSecond});
}

}  // namespace

PaperTable measurePapers1And2(const PaperBench& bench, Progress& progress) {
  const std::filesystem::path folder = paperScenes(bench);
  std::vector<Scene> scenes;  // errors in a scene are reported before anything is measured
  for (const Row& row : kRows) scenes.push_back(loadScene(folder / (std::string(row.scene) + ".toml")));
  BenchDevice device(bench);
  PaperTable table{
      "papers-1-2",
      "Paper 1, table 1, and paper 2: 640 x 480, tables of 129 directions, light, casters, receivers and "
      "camera moving; " +
          device.on,
      {}};
  for (std::size_t i = 0; i < kRows.size(); ++i)
    addRow(table, kRows[i], scenes[i], device.orNone(), progress);
  return table;
}

}  // namespace nephroid
