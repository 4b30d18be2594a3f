// The mesh of rays against independently counted photons, exact mappings and closed forms.
#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include <algorithm>

#include "support/counted_answers.h"
#include "techniques/adaptive_beams/landed_light.h"
#include "techniques/adaptive_beams/sensor_light.h"

namespace nephroid {
namespace {

struct SensorLight {
  std::vector<vec3> lux;  // of each texel
  RayMesh mesh;
};

SensorLight lightIn(const Scene& scene, Paths paths, float error = 0.01f) {
  Progress progress;
  const RayScene rays(scene);
  SensorLight light;
  light.lux =
      lightOnSensor(scene, rays, scene.sensors.at(0), {.error = error, .paths = paths}, light.mesh, progress);
  return light;
}

struct Case {
  const char* scene;
  const char* answer;
  Paths paths;
  double fluxTolerance;  // of the flux
  double rmseTolerance;  // of the mean, off the focus; the answer's own spread is part of it
};

void PrintTo(const Case& c, std::ostream* out) {
  *out << c.answer;
}

class RayMeshTruth : public testing::TestWithParam<Case> {};

TEST_P(RayMeshTruth, IsMet) {
  const Case& wanted = GetParam();
  const std::filesystem::path folder = sharedData() / "truth";
  if (!std::filesystem::exists(folder / wanted.answer)) GTEST_SKIP() << "no " << folder / wanted.answer;
  const Scene scene = loadScene(folder / (std::string(wanted.scene) + ".toml"));
  const std::vector<vec3> lux = lightIn(scene, wanted.paths).lux;
  const Image answer = readPfm(folder / wanted.answer);
  const std::vector<float>& truth = *answer.find("G");
  ASSERT_EQ(lux.size(), truth.size());
  const TruthErrors errors = errorsAgainst(truth, lux);
  EXPECT_NEAR(errors.fluxRatio, 1, wanted.fluxTolerance);
  // A focus and the last texels of folds are a hundredth of a sensor.
  EXPECT_LT(errors.withoutWorst, wanted.rmseTolerance);
}

constexpr Case kCases[] = {
    {"ball-point", "ball-point.transmission.pfm", Paths::transmission, 0.005, 0.02},
    {"ball-point", "ball-point.all.pfm", Paths::all, 0.005, 0.02},
    {"ball-sun-0.6", "ball-sun-0.6.transmission.pfm", Paths::transmission, 0.005, 0.02},
    {"ball-sun-0.6", "ball-sun-0.6.all.pfm", Paths::all, 0.005, 0.02},
    {"ball-sun-0.75", "ball-sun-0.75.transmission.pfm", Paths::transmission, 0.005, 0.02},
    {"ball-sun-0.75", "ball-sun-0.75.all.pfm", Paths::all, 0.005, 0.02},
    {"ball-sun-1.2", "ball-sun-1.2.transmission.pfm", Paths::transmission, 0.005, 0.02},
    {"ball-sun-1.2", "ball-sun-1.2.all.pfm", Paths::all, 0.005, 0.02},
    {"bunny-point", "bunny-point.transmission.pfm", Paths::transmission, 0.01, 0.25},
    {"bunny-point", "bunny-point.all.pfm", Paths::all, 0.01, 0.25},
    // The answer lost the photons that a smooth normal sent through the mesh (reference/truth_test.cpp).
    {"spot-coloured", "spot-coloured.transmission.pfm", Paths::transmission, 0.015, 0.4},
    {"spot-coloured", "spot-coloured.all.pfm", Paths::all, 0.025, 0.4},
    {"mirror-ring", "mirror-ring.all.pfm", Paths::all, 0.005, 0.04},
    {"sine-0.5", "sine-0.5.pfm", Paths::all, 0.005, 0.01},
    {"sine-0.9", "sine-0.9.pfm", Paths::all, 0.005, 0.01},
    {"sine-2.0", "sine-2.0.pfm", Paths::all, 0.005, 0.02},
};

INSTANTIATE_TEST_SUITE_P(Scenes, RayMeshTruth, testing::ValuesIn(kCases));

class RayMeshShippedTruth : public testing::TestWithParam<CountedTruth> {};

// Of the error that is asked for, and of the counts' own. The mean of what texels are off is no larger than
// its root mean square, so that the flux has the same bound.
TEST_P(RayMeshShippedTruth, IsMetWithinTheErrorAskedFor) {
  constexpr double kError = 0.01;
  const CountedTruth& truth = GetParam();
  const std::vector<vec3> lux = lightIn(loadScene(truth.scene), Paths::all, float(kError)).lux;
  ASSERT_EQ(lux.size(), truth.lux.size());
  const TruthErrors errors = errorsAgainst(truth.lux, lux);
  EXPECT_NEAR(errors.fluxRatio, 1, kError + truth.spread);
  // The error that is asked for does not tell the last texels of folds and of a focus.
  EXPECT_LT(errors.withoutWorst, kError + truth.spread);
}

INSTANTIATE_TEST_SUITE_P(Scenes, RayMeshShippedTruth, testing::ValuesIn(shippedTruths()));

// Glass before and behind water, 10 lx straight down: by Fresnel's equations alone.
TEST(RayMesh, FlatFacesLeaveAnEvenLight) {
  const auto mean = [](const char* name) {
    const std::filesystem::path file = sharedData() / "cases" / name;
    const std::vector<vec3> lux = lightIn(loadScene(file), Paths::transmission).lux;
    const auto [least, most] = std::ranges::minmax_element(lux, {}, [](vec3 v) { return v.y; });
    EXPECT_LT(most->y - least->y, 1e-3f * most->y);
    return double(least->y);
  };
  if (!std::filesystem::exists(sharedData() / "cases")) GTEST_SKIP() << "no cases";
  EXPECT_NEAR(mean("sandwich_overlap.toml"), 9.150, 0.002);
  EXPECT_NEAR(mean("sandwich_gap.toml"), 8.156, 0.002);
  EXPECT_NEAR(mean("sandwich_touch.toml"), 9.150, 0.002);
}

TEST(RayMesh, IsTheSameForAnyNumberOfThreads) {
  const Scene scene = loadScene(std::filesystem::path(NEPHROID_SOURCE_DIR) / "scenes" / "glass-ball.toml");
  const std::vector<vec3> all = lightIn(scene, Paths::all, 0.05f).lux;
  const oneapi::tbb::global_control one(oneapi::tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_EQ(lightIn(scene, Paths::all, 0.05f).lux, all);
}

// What receivers look up is what a sensor between them and the light measures.
TEST(RayMesh, LandedLightIsThatOfASensor) {
  const Scene scene = loadScene(std::filesystem::path(NEPHROID_SOURCE_DIR) / "scenes" / "glass-ball.toml");
  const RayScene rays(scene);
  Progress progress;
  RayMeshSettings settings;
  settings.detail = 0.005f;
  LandedLight light;
  RayMesh mesh;
  traceRayMesh(scene, rays, settings, progress, mesh);
  light.build(mesh);
  const Sensor& sensor = scene.sensors.at(0);
  constexpr uint32_t kPoints = 4;  // along a texel's side
  double looked = 0, measured = 0;
  for (const vec3& lux : lightIn(scene, Paths::all).lux) measured += double(lux.y) * kPoints * kPoints;
  for (uint32_t y = 0; y < kPoints * sensor.resolution.y; ++y)
    for (uint32_t x = 0; x < kPoints * sensor.resolution.x; ++x) {
      const vec2 at = (vec2(float(x), float(y)) + 0.5f) / vec2(kPoints * sensor.resolution);
      looked +=
          double(light.illuminanceAt(sensor.corner + at.x * sensor.u + at.y * sensor.v, sensor.normal()).y);
    }
  EXPECT_NEAR(looked / measured, 1, 0.01);
}

}  // namespace
}  // namespace nephroid
