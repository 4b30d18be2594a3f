// Gobos, profiles, colors, lines, panels and skies in direct light and beams, against the reference.
#include <gtest/gtest.h>

#include <filesystem>

#include "formats/ies.h"
#include "formats/load.h"
#include "lights/light_intensity.h"
#include "lights/sky.h"
#include "render/measure.h"
#include "support/reference_scenes.h"
#include "support/scratch_files.h"
#include "support/sensor_blocks.h"
#include "support/shared_data.h"
#include "transport/traced/traced_source.h"

namespace nephroid {
namespace {

constexpr uint32_t kPasses = 16;

const vec3 kLamp(-0.6f, 2.4f, 0.3f), kBall(0, 0.7f, 0);

Scene floorAndBall() {
  Scene scene;
  add(scene, makePlane({8, 8}), diffuse(0.6f));
  add(scene, makeSphere(0.4f, {.segments = 64}), glass(), kBall);
  return scene;
}

Light lampAtBall() {
  Light light = spotLight(kLamp, kBall, 20, 24);
  light.intensity = {100, 60, 20};
  return light;
}

// Squares of `period` texels, in colors that add up to white.
Texture checkers(uint32_t size, uint32_t period) {
  Texture gobo{"checkers", size, size, {}};
  for (uint32_t y = 0; y < size; ++y)
    for (uint32_t x = 0; x < size; ++x)
      gobo.texels.push_back((x / period + y / period) % 2 == 0 ? vec4(1, 0.3f, 0, 1) : vec4(0, 0.7f, 1, 1));
  return gobo;
}

void expectAsReference(const Scene& scene) {
  const Sensor sensor = floorSensor({0.1f, 0, -0.05f}, 0.6f, kBlocks * kTexelsOfBlock);
  const RayScene rays(scene);
  const TracedSource source(scene, rays);
  Progress progress;
  Stats stats;
  const SensorLayer direct = measureDirect(scene, rays, sensor, 0.01f, progress);
  const SensorLayer caustics =
      measureBeams(scene, rays, source, sensor, Paths::transmission, 2, progress, stats);
  ReferenceSettings settings;
  settings.paths = Paths::transmission;
  settings.photons = photonsOf(1 << 17);
  ReferenceSensor meter(scene, rays, sensor, settings);
  const auto means =
      blockMeans(meter, {"direct.R", "direct.B", "caustics.R", "caustics.B"}, kPasses, kTexelsOfBlock);
  expectMean(blocksOf(direct, 0), means[0], "direct, red");
  expectMean(blocksOf(direct, 2), means[1], "direct, blue");
  expectMean(blocksOf(caustics, 0), means[2], "caustics, red");
  expectMean(blocksOf(caustics, 2), means[3], "caustics, blue");
}

TEST(LightThroughABall, OfASpotWithASharpCone) {
  Scene scene = floorAndBall();
  Light light = lampAtBall();
  light.innerAngle = light.outerAngle = 9;  // within the ball
  scene.lights.push_back(light);
  expectAsReference(scene);
}

// Squares of the gobo are about as large as triangles of the ball.
TEST(LightThroughABall, OfAGobo) {
  Scene scene = floorAndBall();
  scene.textures.push_back(checkers(96, 3));
  Light light = lampAtBall();
  light.goboTexture = 0;
  scene.lights.push_back(light);
  expectAsReference(scene);
}

TEST(LightThroughABall, OfAProfile) {
  Scene scene = floorAndBall();
  scene.profiles.push_back(
      {"streaks", PhotometryType::c, {0, 5, 10, 15, 90}, {0, 45, 90, 135, 180}, {}, 100});
  for (int i = 0; i < 25; ++i) scene.profiles[0].fractions.push_back(i % 3 == 0 ? 1.0f : 0.2f);
  Light light = lampAtBall();
  light.profile = 0;
  light.innerAngle = light.outerAngle = 180;
  scene.lights.push_back(light);
  expectAsReference(scene);
}

TEST(LightThroughABall, OfAGobosCopyInAnotherColorAndALine) {
  Scene scene = floorAndBall();
  scene.textures.push_back(checkers(32, 4));
  Light spot = lampAtBall();
  spot.goboTexture = 0;
  Light other = spotLight({1, 2, 0.8f}, kBall, 10, 24);
  other.intensity = {5, 20, 80};
  other.goboTexture = 0;
  Light line = lineLight({-1, 2.2f, -0.5f}, {0.5f, 2.6f, 0.4f});
  line.samples = 64;  // as good as a line
  line.intensity = {50, 50, 100};
  scene.lights = {spot, other, line};
  expectAsReference(scene);
}

TEST(LightThroughABall, OfAPanel) {
  Scene scene = floorAndBall();
  Light light = lampAtBall();
  light.type = LightType::area;
  light.u = {0, 0.1f, 0.5f};
  light.v = {0.6f, 0.1f, 0};
  light.direction = normalize(cross(light.v, light.u));
  light.grid = {12, 12};  // as good as a panel
  scene.lights.push_back(light);
  expectAsReference(scene);
}

// Brighter above, and red at one side.
TEST(LightThroughABall, OfASky) {
  Scene scene = floorAndBall();
  SkyMap map{"sky", {64, 32}, {}};
  for (uint32_t i = 0; i < 64 * 32; ++i)
    map.luminance.emplace_back(vec3(i % 64 < 20 ? 3.0f : 1, 1, 1) * (i < 64 * 16 ? 100.0f : 10.0f));
  scene.skies.push_back(map);
  Light light;
  light.type = LightType::sky;
  light.skyMap = 0;
  light.skyRotation = 30;
  light.sky = skyParts(map, 256);
  scene.lights.push_back(light);
  expectAsReference(scene);
}

// Rays part at every edge.
TEST(LightThroughABox, OfALamp) {
  Scene scene;
  add(scene, makePlane({8, 8}), diffuse(0.6f));
  Object& box = add(scene, makeBox({0.5f, 0.4f, 0.6f}), glass(), kBall);
  box.placement.rotation = normalize(quat(0.9f, 0.2f, 0.3f, 0.1f));
  scene.lights.push_back(pointLight(kLamp));
  expectAsReference(scene);
}

class StageLight : public ScratchFiles {};

TEST_F(StageLight, ThroughABallIsAsTheReferenceHasIt) {
  const auto file = sharedData() / "data" / "stage" / "gobos" / "gobo00010-512.png";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "no " << file;
  Scene scene = floorAndBall();
  scene.textures = loadScene(write("scene.toml",
                                   "[[light]]\ntype = \"spot\"\ndirection = [0, -1, 0]\n"
                                   "position = [0, 1, 0]\nintensity = 1\ngobo = '" +
                                       std::filesystem::absolute(file).string() + "'\n"))
                       .textures;
  Light light = lampAtBall();
  light.goboTexture = 0;
  scene.lights.push_back(light);
  expectAsReference(scene);
}

TEST(LightThroughABall, OfAMeasuredLamp) {
  const auto file = sharedData() / "data" / "ies" / "eulumdat-rs-ABSOLUTE_LED.ies";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "no " << file;
  Scene scene = floorAndBall();
  scene.profiles.push_back(loadIes(file));
  Light light = lampAtBall();
  light.profile = 0;
  light.innerAngle = light.outerAngle = 180;
  scene.lights.push_back(light);
  expectAsReference(scene);
}

}  // namespace
}  // namespace nephroid
