// The beams alone against independently counted photons and exact mappings.
#include <gtest/gtest.h>

#include <cmath>

#include "core/image_io.h"
#include "formats/load.h"
#include "render/measure.h"
#include "support/shared_data.h"
#include "transport/traced/traced_source.h"

namespace nephroid {
namespace {

struct Case {
  const char* scene;
  const char* answer;
  Paths paths;
  uint32_t refineDepth;
  double fluxTolerance;  // of the flux
  double rmseTolerance;  // of the mean; the answer's own spread is part of it
};

void PrintTo(const Case& c, std::ostream* out) {
  *out << c.answer;
}

class Truth : public testing::TestWithParam<Case> {};

TEST_P(Truth, IsMetByTheBeamsAlone) {
  const Case& wanted = GetParam();
  const std::filesystem::path folder = sharedData() / "truth";
  if (!std::filesystem::exists(folder / wanted.answer)) GTEST_SKIP() << "no " << folder / wanted.answer;
  const Scene scene = loadScene(folder / (std::string(wanted.scene) + ".toml"));
  const Image answer = readPfm(folder / wanted.answer);
  const RayScene rays(scene);
  const TracedSource source(scene, rays);
  Progress progress;
  Stats stats;
  const SensorLayer layer = measureBeams(scene, rays, source, scene.sensors.at(0), wanted.paths,
                                         wanted.refineDepth, progress, stats);
  const std::vector<float>& truth = *answer.find("G");
  ASSERT_EQ(layer.size(), truth.size());
  double sum = 0, truthSum = 0, squares = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    sum += double(layer[i].y);
    truthSum += double(truth[i]);
    squares += std::pow(double(layer[i].y) - double(truth[i]), 2);
  }
  EXPECT_NEAR(sum / truthSum, 1, wanted.fluxTolerance);
  EXPECT_LT(std::sqrt(squares / double(truth.size())) / (truthSum / double(truth.size())),
            wanted.rmseTolerance);
}

// Tolerances are the project's own bars: 1 % of the flux and 5 % for balls of 25,600 vertices, 3 % of the
// flux for scanned meshes, whose sharp folds leave a texel's worth of difference at every line; 0.5 % of the
// flux for waves.
constexpr Case kCases[] = {
    {"ball-point", "ball-point.transmission.pfm", Paths::transmission, 1, 0.01, 0.05},
    {"ball-point", "ball-point.all.pfm", Paths::all, 1, 0.01, 0.05},
    {"ball-sun-0.6", "ball-sun-0.6.transmission.pfm", Paths::transmission, 1, 0.01, 0.05},
    {"ball-sun-0.75", "ball-sun-0.75.transmission.pfm", Paths::transmission, 1, 0.01, 0.05},
    {"ball-sun-0.75", "ball-sun-0.75.all.pfm", Paths::all, 1, 0.01, 0.05},
    {"ball-sun-1.2", "ball-sun-1.2.transmission.pfm", Paths::transmission, 1, 0.01, 0.05},
    {"bunny-point", "bunny-point.transmission.pfm", Paths::transmission, 2, 0.03, 0.5},
    {"spot-coloured", "spot-coloured.transmission.pfm", Paths::transmission, 2, 0.03, 1.0},
    {"mirror-ring", "mirror-ring.all.pfm", Paths::all, 1, 0.01, 0.15},
    {"sine-0.5", "sine-0.5.pfm", Paths::transmission, 1, 0.005, 0.05},
    {"sine-0.9", "sine-0.9.pfm", Paths::transmission, 1, 0.005, 0.05},
    {"sine-2.0", "sine-2.0.pfm", Paths::transmission, 1, 0.005, 0.05},
};

INSTANTIATE_TEST_SUITE_P(Scenes, Truth, testing::ValuesIn(kCases));

}  // namespace
}  // namespace nephroid
