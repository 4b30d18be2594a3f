// Photons counted on a floor without a kernel, and the same floor seen by a camera through photon mapping.
#include <gtest/gtest.h>

#include <filesystem>

#include "formats/mesh_file.h"
#include "geometry/bounds.h"
#include "support/reference_scenes.h"

namespace nephroid {
namespace {

constexpr uint32_t kBlocks = 4;  // along a side of what is compared
constexpr uint32_t kPasses = 24;
constexpr uint32_t kPixels = 112;  // along a side: much smaller than a block, as is the kernel
constexpr float kReflectance = 0.6f;

// A floor at y = 0, and a square part of it that nothing hides from a camera above.
struct Arrangement {
  Scene scene;
  vec3 center{0.8f, 0, 0};
  float halfSize = 0.4f;
  float cameraHeight = 4;
};

// A caster of 0.8 m at most, lit from the left: its caustic lies to the right of it.
constexpr vec3 kCaster{0, 0.8f, 0};
constexpr vec3 kLamp{-1.5f, 2.6f, 0.1f};

Arrangement lit(const Light& light, Mesh caster, const Material& material) {
  Arrangement made;
  made.scene.lights = {light};
  add(made.scene, makePlane({8, 8}), diffuse(kReflectance));
  add(made.scene, std::move(caster), material, kCaster);
  return made;
}

void expectAgreement(const Arrangement& arrangement, SeenDirectly seen = SeenDirectly::gathered) {
  Scene scene = arrangement.scene;
  scene.camera.position = arrangement.center + vec3(0, arrangement.cameraHeight, 0);
  scene.camera.target = arrangement.center;
  scene.camera.verticalFov = 2 * glm::degrees(std::atan(arrangement.halfSize / arrangement.cameraHeight));
  const Sensor sensor = floorSensor(arrangement.center, arrangement.halfSize, kBlocks);
  const RayScene rays(scene);
  ReferenceSettings settings;
  settings.size = uvec2(kPixels);
  settings.photons = 1 << 13;
  const std::vector<std::string> channels = {"caustics.R", "caustics.B", "direct.G"};
  ReferenceSensor meter(scene, rays, sensor, settings);
  const auto counted = blockMeans(meter, channels, kPasses, 1);
  settings.seed = 2;
  settings.seenDirectly = seen;
  ReferenceImage image(scene, rays, settings);
  const auto looked = blockMeans(image, channels, kPasses, kPixels / kBlocks);
  for (std::size_t c = 0; c < channels.size(); ++c) {
    double chiSquare = 0, degrees = 0;
    for (std::size_t block = 0; block < counted[c].size(); ++block) {
      const SampleMean &lux = counted[c][block], &nits = looked[c][block];
      const double toLux = double(kPi / kReflectance);
      const double difference = lux.mean() - toLux * nits.mean();
      const double error =
          std::hypot(lux.standardError(), toLux * nits.standardError(), 1e-5 * lux.mean());  // and rounding
      // Where hardly a photon comes its spread is not known.
      if (lux.mean() <= 10 * lux.standardError()) continue;
      chiSquare += difference * difference / (error * error);
      ++degrees;
    }
    // The spread is itself known from so few passes: Student's variance.
    chiSquare *= (kPasses - 3.0) / (kPasses - 1.0);
    EXPECT_GE(degrees, channels[c] == "direct.G" ? 0 : 4) << channels[c];
    EXPECT_LE(chiSquare, degrees > 0 ? chiSquareLimit(degrees) : 0)
        << channels[c] << ", of " << degrees << " degrees of freedom";
  }
}

TEST(Agreement, OnABallPutIntoThePicture) {
  expectAgreement(lit(pointLight(kLamp), makeSphere(0.4f), glass()), SeenDirectly::splatted);
}

TEST(Agreement, OnABallUnderALamp) {
  expectAgreement(lit(pointLight(kLamp), makeSphere(0.4f), glass()));
}

TEST(Agreement, OnABallUnderTheSun) {
  expectAgreement(lit(sun(kCaster - kLamp), makeSphere(0.4f), glass(1.4f)));
}

TEST(Agreement, OnATorusOfWater) {
  expectAgreement(lit(pointLight(kLamp), makeTorus(0.28f, 0.12f), glass(1.33f)));
}

TEST(Agreement, OnAKnotInASpotLight) {
  expectAgreement(lit(spotLight(kLamp, kCaster, 5, 15), makeTorusKnot(2, 3, 0.25f, 0.08f), glass()));
}

TEST(Agreement, OnABallUnderATube) {
  expectAgreement(
      lit(lineLight(kLamp - vec3(0, 0, 0.4f), kLamp + vec3(0.2f, 0.1f, 0.4f)), makeSphere(0.4f), glass()));
}

TEST(Agreement, OnABoxOfTintedGlass) {
  Material tinted = glass();
  tinted.attenuationColor = {0.3f, 0.6f, 0.9f};
  tinted.attenuationDistance = 0.3f;
  expectAgreement(lit(pointLight(kLamp), makeBox({0.5f, 0.4f, 0.6f}), tinted));
}

TEST(Agreement, OnAPrismThatDisperses) {
  Material flint = glass();
  flint.ior = {1.59f, 1.61f, 1.66f};
  expectAgreement(lit(sun(kCaster - kLamp), makePrism(0.35f, 0.7f), flint));
}

TEST(Agreement, OnTwoCastersInARow) {
  Arrangement row = lit(pointLight(kLamp), makeSphere(0.3f), glass());
  add(row.scene, makeTorus(0.15f, 0.1f), glass(1.4f), glm::mix(kLamp, kCaster, 0.6f));
  expectAgreement(row);
}

TEST(Agreement, OnAMirrorBallAndABubble) {
  Arrangement balls = lit(pointLight({2.5f, 1.5f, 0}), makeSphere(0.4f), mirror(0.9f));
  add(balls.scene, makeSphere(0.25f), glass(), {-0.2f, 0.3f, 0.8f});
  add(balls.scene, makeSphere(0.2f), glass(1), {-0.2f, 0.3f, 0.8f});
  expectAgreement(balls);
}

TEST(Agreement, InAMirrorRing) {
  Arrangement ring;
  ring.scene.lights = {sun({1, -0.6f, 0})};
  add(ring.scene, makePlane({8, 8}), diffuse(kReflectance));
  add(ring.scene, makeRing(0.5f, 0.2f, 0.01f, {.segments = 256}), mirror(0.9f), {0, 0.1f, 0});
  ring.center = {0.22f, 0, 0};
  ring.halfSize = 0.2f;
  expectAgreement(ring);
}

TEST(Agreement, UnderWaves) {
  Arrangement pool;
  pool.scene.lights = {sun({0.3f, -1, 0.2f})};
  add(pool.scene, makePlane({8, 8}), diffuse(kReflectance));
  Water water;
  water.size = {2.4f, 2.4f};
  water.grid = {96, 96};
  water.waves = {{0.01f, 0.4f, {1, 0}, 0, 0}, {0.015f, 0.6f, {0.6f, 0.8f}, 0, 1}};
  add(pool.scene, makeWater(water, 0), glass(1.33f), {0, 1, 0});
  pool.center = vec3(0);
  pool.cameraHeight = 0.9f;  // in the water
  expectAgreement(pool);
}

TEST(Agreement, OnABunny) {
  const std::filesystem::path file = "/usr/share/glmark2/models/bunny.obj";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "no " << file;
  Mesh bunny = loadMeshFile(file);
  const Box box = boundingBox(bunny);
  const float scale = 0.7f / box.longestSide();
  for (vec3& p : bunny.positions) p = (p - box.center()) * scale;
  expectAgreement(lit(pointLight(kLamp), std::move(bunny), glass()));
}

}  // namespace
}  // namespace nephroid
