// Surfaces that lie in the same place are one boundary, and rays leave surfaces by what their floats round.
#include <gtest/gtest.h>

#include "optics/refraction.h"
#include "report/diagnose.h"
#include "support/reference_scenes.h"
#include "techniques/adaptive_beams/sensor_light.h"

namespace nephroid {
namespace {

constexpr float kLux = 10;

Sensor meterOver(float half, vec3 middle = vec3(0)) {
  Sensor sensor;
  sensor.name = "floor";
  sensor.corner = middle + vec3(-half, 0, -half);
  sensor.u = {2 * half, 0, 0};
  sensor.v = {0, 0, 2 * half};
  sensor.resolution = {8, 8};
  return sensor;
}

// Light straight down, over a floor.
Scene underSun() {
  Scene scene;
  add(scene, makePlane({20, 20}, {.segments = 1}), diffuse(0.7f));
  scene.lights.push_back(sun({0, -1, 0}, kLux));
  scene.sensors.push_back(meterOver(0.1f));
  return scene;
}

double meanOf(const std::vector<vec3>& lux) {
  double sum = 0;
  for (const vec3& texel : lux) sum += double(texel.y);
  return sum / double(lux.size());
}

double byBeams(const Scene& scene, Paths paths = Paths::transmission) {
  Progress progress;
  RayMesh mesh;
  const RayScene rays(scene);
  return meanOf(
      lightOnSensor(scene, rays, scene.sensors[0], {.error = 0.01f, .paths = paths}, mesh, progress));
}

double byReference(const Scene& scene, Paths paths = Paths::transmission) {
  const RayScene rays(scene);
  ReferenceSettings settings;
  settings.paths = paths;
  settings.photons = 200'000;
  ReferenceSensor sensor(scene, rays, scene.sensors[0], settings);
  sensor.pass();
  const Image image = sensor.image();
  double sum = 0;
  for (const float value : *image.find("caustics.G")) sum += double(value);
  return sum / double(image.find("caustics.G")->size());
}

// What goes straight through boundaries between these indices of refraction.
double through(std::initializer_list<float> iors) {
  double left = double(kLux);
  for (auto ior = iors.begin(); ior + 1 != iors.end(); ++ior)
    left *= 1 - double(fresnelReflectance(1, ior[0] / ior[1]));
  return left;
}

void expectLux(const Scene& scene, double lux) {
  EXPECT_NEAR(byBeams(scene), lux, 1e-3 * lux);
  // Photons are spread evenly over the casters' balls; of 200,000 some 1,000 meet the sensor.
  EXPECT_NEAR(byReference(scene), lux, 0.02 * lux);
}

TEST(Contacts, FacesOfTwoMediaAreOneBoundary) {
  Scene scene = underSun();
  add(scene, makeBox({1, 0.1f, 1}), glass(1.5f), {0, 0.6f, 0});
  add(scene, makeBox({1, 0.1f, 1}), glass(1.33f), {0, 0.5f, 0});
  add(scene, makeBox({1, 0.1f, 1}), glass(1.5f), {0, 0.4f, 0});
  expectLux(scene, through({1, 1.5f, 1.33f, 1.5f, 1}));
}

TEST(Contacts, PanesOfOneGlassAreOnePane) {
  Scene scene = underSun();
  for (const float y : {0.4f, 0.5f, 0.6f}) add(scene, makeBox({1, 0.1f, 1}), glass(1.5f), {0, y, 0});
  expectLux(scene, through({1, 1.5f, 1}));
}

// Whichever of the two is the first object.
TEST(Contacts, HoldWhereABoxStandsOnALargerOne) {
  for (const bool isUpperFirst : {false, true}) {
    Scene scene = underSun();
    if (isUpperFirst) add(scene, makeBox({0.4f, 0.3f, 0.4f}), glass(1.33f), {0, 0.75f, 0});
    add(scene, makeBox({1, 0.2f, 1}), glass(1.5f), {0, 0.5f, 0});
    if (!isUpperFirst) add(scene, makeBox({0.4f, 0.3f, 0.4f}), glass(1.33f), {0, 0.75f, 0});
    expectLux(scene, through({1, 1.33f, 1.5f, 1}));
    scene.sensors[0] = meterOver(0.1f, {0.35f, 0, 0});
    expectLux(scene, through({1, 1.5f, 1}));
  }
}

// As files give it that were written with six digits.
TEST(Contacts, HoldWithinTheDigitsOfFiles) {
  Scene scene = underSun();
  add(scene, makeBox({1, 0.1f, 1}), glass(1.5f), {0, 0.5f, 0});
  add(scene, makeBox({1, 0.1f, 1}), glass(1.33f), {0, 0.600001f, 0});
  expectLux(scene, through({1, 1.33f, 1.5f, 1}));
}

TEST(Contacts, AnAirGapIsNone) {
  Scene scene = underSun();
  add(scene, makeBox({1, 0.1f, 1}), glass(1.5f), {0, 0.5f, 0});
  add(scene, makeBox({1, 0.1f, 1}), glass(1.33f), {0, 0.6001f, 0});
  EXPECT_TRUE(RayScene(scene).contacts().areNone());
  expectLux(scene, through({1, 1.33f, 1, 1.5f, 1}));
}

TEST(Contacts, AnObjectThatStandsTwiceCountsOnce) {
  Scene scene = underSun();
  for (int i = 0; i < 2; ++i) add(scene, makeBox({1, 0.1f, 1}), glass(1.5f), {0, 0.5f, 0});
  expectLux(scene, through({1, 1.5f, 1}));
}

TEST(Contacts, AreTold) {
  Scene scene = underSun();
  for (const float y : {0.4f, 0.5f, 0.7f}) add(scene, makeBox({1, 0.1f, 1}), glass(1.5f), {0, y, 0});
  for (Object& object : scene.objects) object.name = "box " + std::to_string(&object - scene.objects.data());
  const SceneReport report = diagnose(scene);
  ASSERT_EQ(report.touching.size(), 1u);
  EXPECT_EQ(report.touching[0].objects[0], 1u);
  EXPECT_EQ(report.touching[0].objects[1], 2u);
  EXPECT_NE(describe(scene, report).find("box 1 and box 2 touch"), std::string::npos);
}

// From inside the glass too; nothing is reflected where it meets the floor.
TEST(Contacts, LightGoesFromGlassIntoWhatItStandsOn) {
  Scene scene = underSun();
  add(scene, makeBox({1, 0.2f, 1}), glass(1.5f), {0, 0.1f, 0});
  expectLux(scene, through({1, 1.5f}));
}

TEST(Contacts, ALabelHidesTheGlassBelow) {
  Scene scene = underSun();
  add(scene, makeBox({1, 0.1f, 1}), glass(1.5f), {0, 0.5f, 0});
  add(scene, makePlane({0.5f, 0.5f}, {.segments = 1}), diffuse(0.5f), {0, 0.55f, 0});
  EXPECT_EQ(byBeams(scene), 0);
  EXPECT_EQ(byReference(scene), 0);
}

// Liquid whose walls are those of its glass, round and at any angle: as if it reached a little into the
// glass.
TEST(Contacts, LiquidIsPouredToTheWall) {
  const auto scene = [](float radius) {
    Scene made = underSun();
    made.lights[0] = sun({0.5f, -1, 0.2f}, kLux);
    made.sensors[0] = meterOver(1);
    add(made, makeRing(0.3f, 0.5f, 0.03f, {.segments = 48}), glass(1.5f), {0, 0.5f, 0});
    add(made, makeCylinder(radius, 0.5f, {.segments = 48}), glass(1.33f), {0, 0.5f, 0});
    return made;
  };
  const double touching = byBeams(scene(0.3f));
  EXPECT_FALSE(RayScene(scene(0.3f)).contacts().areNone());
  EXPECT_NEAR(touching / byBeams(scene(0.31f)), 1, 0.03);
  EXPECT_NEAR(touching / byReference(scene(0.3f)), 1, 0.02);
}

// The same at any size.
Scene ballOfRadius(float radius, vec3 at, float halfFloor) {
  Scene scene;
  add(scene, makePlane(vec2(2 * halfFloor), {.segments = 1}), diffuse(0.7f));
  add(scene, makeSphere(radius, {.vertices = 2000}), glass(1.5f), at + vec3(0, 1.6f * radius, 0));
  scene.lights.push_back(sun({0.4f, -1, 0.2f}, kLux));
  scene.sensors.push_back(meterOver(2.6f * radius, at));
  return scene;
}

TEST(Scale, IsNothingThatLightKnows) {
  const double wanted = byBeams(ballOfRadius(0.3f, vec3(0), 3));
  for (const float scale : {1e-3f, 1e3f}) {
    const Scene scene = ballOfRadius(0.3f * scale, vec3(0), 3 * scale);
    EXPECT_NEAR(byBeams(scene) / wanted, 1, 2e-3) << scale;
    EXPECT_NEAR(byReference(scene) / wanted, 1, 0.02) << scale;
  }
}

// A ball of a centimeter, in the middle and at a place where floats are 0.03 mm apart.
TEST(Scale, ASmallBallInALargeSceneKeepsItsCaustic) {
  const double wanted = byBeams(ballOfRadius(0.3f, vec3(0), 3));
  for (const vec3 at : {vec3(0), vec3(300, 0, -400)}) {
    const Scene scene = ballOfRadius(0.005f, at, 1000);
    EXPECT_NEAR(byBeams(scene) / wanted, 1, 0.01) << at.x;
    EXPECT_NEAR(byReference(scene) / wanted, 1, 0.02) << at.x;
  }
}

}  // namespace
}  // namespace nephroid
