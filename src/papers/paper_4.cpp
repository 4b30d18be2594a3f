#include "papers/paper_4.h"

#include <oneapi/tbb/parallel_for.h>

#include <array>

#include "core/atomic_file.h"
#include "core/stopwatch.h"
#include "formats/load.h"
#include "papers/curves.h"
#include "papers/frame_bench.h"
#include "papers/paper_scenes.h"
#include "reference/lights.h"
#include "reference/pinhole.h"
#include "render/metering.h"
#include "scene/air.h"

namespace nephroid {
namespace {

constexpr uvec2 kSizeOfShafts(720, 480);          // pixels
constexpr int kFrames = 5;                        // timed, after one that makes programs
constexpr uint32_t kPlanes = 30, kSubplanes = 6;  // which paper 4 settles on
constexpr std::array<uint32_t, 6> kPlaneCounts{10, 20, 30, 60, 100, 200};   // figure 4
constexpr std::array<uint32_t, 7> kSubplaneCounts{1, 2, 4, 6, 10, 16, 25};  // figure 5
// What is taken as converged: every edge to within a five-thousandth of its ray.
constexpr ShaftSettings kConverged{256, 0, 0.0002f};

// As a screen shows it, 0 to 256 and not rounded, so that what is lost to 8 bits is no part of an error.
using Levels = std::vector<float>;

struct Drawn {
  Image image;
  Levels levels;
  double seconds = 0;  // a frame, the median
  std::vector<AirPlanes> planes;
};

Levels levelsOf(const Image& image, const ToneMapping& toneMapping) {
  Levels levels;
  const std::array<const std::vector<float>*, 3> channels{image.find("R"), image.find("G"), image.find("B")};
  for (std::size_t i = 0; i < image.pixelCount(); ++i) {
    const vec3 shown = displayed({channels[0]->at(i), channels[1]->at(i), channels[2]->at(i)}, toneMapping);
    for (int c = 0; c < 3; ++c) levels.push_back(256 * shown[c]);
  }
  return levels;
}

class Bench {
 public:
  Bench(gpu::Device& deviceToUse, Progress& progressToShow)
      : device_(deviceToUse), progress_(progressToShow) {}

  Drawn draw(const Scene& scene, const ShaftSettings& shafts, int frames = kFrames) const {
    FrameBench bench(device_, scene, papersSettings("none"), {.size = kSizeOfShafts, .shafts = shafts},
                     progress_);
    const double seconds = bench.seconds({.warmUps = 1, .frames = frames}, scene);
    Drawn drawn{bench.renderer().layers(), {}, seconds, bench.renderer().shafts().planes()};
    drawn.levels = levelsOf(drawn.image, toneMappingOf(scene.camera, drawn.image));
    return drawn;
  }

 private:
  gpu::Device& device_;
  Progress& progress_;
};

double rootMeanSquare(const Levels& a, const Levels& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += double(a[i] - b[i]) * double(a[i] - b[i]);
  return std::sqrt(sum / double(a.size()));
}

// What paper 4 compares with, after Nishita 1987: at so many even steps along each ray a shadow ray, the air
// and the light evaluated. What surfaces show is taken from `surfaces`.
struct Marched {
  Levels levels;
  double seconds = 0;
};
Marched marchRays(const Scene& scene, const Image& surfaces) {
  constexpr int kSteps = 180;
  constexpr float kFarthest = 14;  // m
  const Stopwatch watch;
  const RayScene rays(scene);
  const Lights lights(scene, Aim::everywhere);
  const Pinhole camera(scene.camera, kSizeOfShafts);
  const Medium& air = *scene.medium;
  Image image = surfaces;
  oneapi::tbb::parallel_for(0u, kSizeOfShafts.y, [&](uint32_t row) {
    for (uint32_t column = 0; column < kSizeOfShafts.x; ++column) {
      const std::size_t pixel = std::size_t(row) * kSizeOfShafts.x + column;
      const Ray ray = camera.rayThrough(vec2(column, row) + 0.5f);
      Hit hit;
      const float length = rays.intersect(ray, hit) ? std::min(hit.distance, kFarthest) : kFarthest;
      vec3 sum(0);
      for (int i = 0; i < kSteps; ++i) {
        const float along = (float(i) + 0.5f) / float(kSteps) * length;
        const vec3 point = ray.origin + along * ray.direction;
        for (uint32_t light = 0; light < lights.count(); ++light) {
          const Illumination lit = lights.illumination(light, point, 0);
          if (rays.occluded({point, -lit.direction, 0, lit.distance})) continue;
          const float depth = opticalDepth(air, ray.origin, ray.direction, along) +
                              opticalDepth(air, point, -lit.direction, lit.distance);
          sum += lit.illuminance * (scatteringAt(air, point) *
                                    phaseOf(air, -dot(lit.direction, ray.direction)) * std::exp(-depth));
        }
      }
      for (int c = 0; c < 3; ++c) {
        const std::string name(1, "RGB"[c]);
        image.channel(name)[pixel] +=
            sum[c] * length / float(kSteps) - image.channel("shafts." + name)[pixel];
      }
    }
  });
  return {levelsOf(image, toneMappingOf(scene.camera, image)), watch.seconds()};
}

std::string rowOf(const char* figure, const char* symbol, uint32_t count) {
  return std::string(figure) + ", " + symbol + " = " + std::to_string(count);
}

}  // namespace

PaperTable measurePaper4(const PaperBench& bench, Progress& progress) {
  const std::filesystem::path folder = paperScenes(bench);
  const Scene ball = loadScene(folder / "paper4-spot.toml"), stage = loadScene(folder / "paper4-stage.toml");
  Scene spotAlone = ball;
  spotAlone.objects.clear();
  gpu::Device device({.device = bench.device});
  const Bench draws(device, progress);
  PaperTable table{
      "paper-4",
      "Paper 4, figures 4 to 7: 720 x 480, n sampling planes of m sub-planes; errors are root mean "
      "squares in 256 levels against the converged integral; on " +
          device.info().name,
      {}};
  const auto add = [&](const std::string& row, const char* quantity, const char* unit, double paper,
                       double ours, double asked = kNoFigure) {
    table.figures.push_back({row, quantity, unit, paper, ours, asked, true});
  };
  progress.begin("paper 4", kPlaneCounts.size() + kSubplaneCounts.size() + 4);

  Chart byPlanes{
      "Figure 4: one spotlight, m = 1", "sampling planes n", {"error (levels)", {}}, {"time (s)", {}}};
  const Levels convergedAlone = draws.draw(spotAlone, kConverged, 0).levels;
  for (const uint32_t planes : kPlaneCounts) {
    const Drawn drawn = draws.draw(spotAlone, {planes, 1, 0});
    const double error = rootMeanSquare(drawn.levels, convergedAlone);
    const std::string row = rowOf("figure 4", "n", planes);
    add(row, "error", "levels", kNoFigure, error);
    add(row, "time", "s", planes == kPlanes ? 0.05 : kNoFigure, drawn.seconds);
    byPlanes.left.points.emplace_back(planes, error);
    byPlanes.right.points.emplace_back(planes, drawn.seconds);
    progress.advance();
  }

  Chart bySubplanes{
      "Figure 5: a ball in the light, n = 30", "sub-planes m", {"error (levels)", {}}, {"time (s)", {}}};
  const Levels converged = draws.draw(ball, kConverged, 0).levels;
  for (const uint32_t subplanes : kSubplaneCounts) {
    const Drawn drawn = draws.draw(ball, {kPlanes, subplanes, 0});
    const double error = rootMeanSquare(drawn.levels, converged);
    const bool isSettled = subplanes == kSubplanes;
    const std::string row = rowOf("figure 5", "m", subplanes);
    add(row, "error", "levels", isSettled ? 1.0 : kNoFigure, error);
    add(row, "time", "s", isSettled ? 0.17 : kNoFigure, drawn.seconds);
    bySubplanes.left.points.emplace_back(subplanes, error);
    bySubplanes.right.points.emplace_back(subplanes, drawn.seconds);
    progress.advance();
  }

  const Drawn automatic = draws.draw(ball, {});
  progress.advance();
  const std::string row = "figure 6, n = " + std::to_string(automatic.planes.at(0).planes) + " and m up to " +
                          std::to_string(automatic.planes.at(0).subplanes) + ", chosen";
  add(row, "error", "levels", 0.026 * 256, rootMeanSquare(automatic.levels, converged), 0.005 * 256);
  add(row, "time", "s", 0.17, automatic.seconds, 0.17);

  const Drawn onStage = draws.draw(stage, {});
  progress.advance();
  const std::string stageRow = "figure 7, five spotlights, chosen";
  add(stageRow, "error", "levels", kNoFigure,
      rootMeanSquare(onStage.levels, draws.draw(stage, kConverged, 0).levels));
  add(stageRow, "time", "s", 1.2, onStage.seconds, 1.2);
  progress.advance();

  const Marched marched = marchRays(ball, automatic.image);
  add("180 steps on each ray, on the host", "error", "levels", kNoFigure,
      rootMeanSquare(marched.levels, converged));
  add("180 steps on each ray, on the host", "time", "s", 27, marched.seconds);
  progress.finish();
  if (!bench.curves.empty()) writeFileAtomically(bench.curves, chartsSvg({byPlanes, bySubplanes}));
  return table;
}

}  // namespace nephroid
