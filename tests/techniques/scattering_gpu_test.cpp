// Light that water scatters toward the eye, against integrals along the line of sight.
#include <cmath>
#include <numbers>

#include "geometry/shapes.h"
#include "optics/refraction.h"
#include "scene/volume.h"
#include "support/drawing.h"
#include "support/gpu_fixture.h"
#include "water/water.h"

namespace nephroid {
namespace {

constexpr double kLux = 1000;
constexpr float kIndex = 1.33f;

double transmitted(double cosIncident) {
  return 1 - double(fresnelReflectance(float(cosIncident), 1 / kIndex));
}

// Light that fell through still water.
struct Inside {
  glm::dvec3 direction;  // unit
  double lux;            // across it, right under the surface
  explicit Inside(vec3 sun) {
    vec3 refracted;
    refractDirection(normalize(sun), {0, 1, 0}, 1 / kIndex, refracted);
    direction = glm::normalize(glm::dvec3(refracted));
    const double cosIncident = double(-normalize(sun).y);
    lux = kLux * cosIncident * transmitted(cosIncident) / -direction.y;
  }
};

class ScatteringGpuTest : public GpuTest {
 protected:
  // The middle of the picture.
  vec3 shaftsOf(const Scene& scene, const std::string& prefix = "shafts.",
                const char* name = "light-volumes") {
    constexpr uvec2 kSize(32, 32);
    const Image layers = Drawing(device(), scene, settingsOf(name), {.size = kSize}).layers(scene);
    vec3 nit;
    for (int c = 0; c < 3; ++c)
      nit[c] = layers.find(prefix + "RGB"[c])->at(kSize.x * kSize.y / 2 + kSize.x / 2);
    return nit;
  }
};

// 6 m of still water, a meter deep.
Scene pool(vec3 sunDirection) {
  Scene scene;
  scene.materials.resize(2);
  Material& water = scene.materials[0];
  water.type = MaterialType::dielectric;
  water.ior = vec3(kIndex);
  water.attenuationColor = {0.5f, 0.8f, 0.9f};
  water.attenuationDistance = 1;
  water.scattering = {0.2f, 0.4f, 0.8f};
  water.phase = PhaseType::henyeyGreenstein;
  water.g = 0.5f;
  Water still;
  still.size = {6, 6};
  still.grid = {60, 60};
  scene.meshes = {makeWater(still, 0), makePlane({40, 40})};
  scene.objects.resize(2);
  scene.objects[0].water = still;
  scene.objects[1].mesh = scene.objects[1].material = 1;
  scene.objects[1].placement.translation = {0, -1, 0};
  Light sun;
  sun.type = LightType::directional;
  sun.direction = normalize(sunDirection);
  sun.illuminance = vec3(float(kLux));
  scene.lights = {sun};
  scene.camera = {.position = {0, 3, 0}, .target = {0, 0, 0}, .up = {0, 0, -1}, .verticalFov = 1};
  return scene;
}

double phaseOf(const Material& water, double cosine) {
  return double(phaseFunction(phaseCode(water.phase), water.g, float(cosine)));
}

void expectNear(vec3 measured, glm::dvec3 expected, double part) {
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(double(measured[c]), expected[c], part * expected[c]) << c;
}

TEST_F(ScatteringGpuTest, FromAboveStillWaterIsItsClosedForm) {
  for (const vec3 sun : {vec3(0, -1, 0), vec3(0.6f, -1, 0.3f)}) {
    const Scene scene = pool(sun);
    const Inside light(sun);
    const Material& water = scene.materials[0];
    const glm::dvec3 perDepth = glm::dvec3(extinctionOf(water)) * (1 - 1 / light.direction.y);
    const glm::dvec3 inWater = glm::dvec3(water.scattering) * phaseOf(water, light.direction.y) * light.lux *
                               (1.0 - glm::exp(-perDepth)) / perDepth;
    expectNear(shaftsOf(scene), inWater * transmitted(1) / double(kIndex * kIndex), 0.005);
  }
}

// Half a meter down, over a meter to a wall.
Scene acrossThePool(vec3 sun) {
  Scene scene = pool(sun);
  scene.meshes.push_back(makeBox({0.2f, 0.7f, 4}));
  Object wall;
  wall.mesh = 2;
  wall.material = 1;
  wall.placement.translation = {1.1f, -0.65f, 0};
  scene.objects.push_back(wall);
  scene.camera = {.position = {-1, -0.6f, 0}, .target = {1, -0.6f, 0}, .verticalFov = 1};
  return scene;
}

// What is scattered toward the camera from x to x.
glm::dvec3 across(const Material& water, const Inside& light, double from, double to) {
  const glm::dvec3 extinction(extinctionOf(water));
  return glm::dvec3(water.scattering) * phaseOf(water, -light.direction.x) * light.lux *
         glm::exp(extinction * 0.6 / light.direction.y) *
         (glm::exp(-extinction * (from + 1)) - glm::exp(-extinction * (to + 1))) / extinction;
}

TEST_F(ScatteringGpuTest, InTheWaterIsItsClosedForm) {
  const vec3 sun(0.4f, -1, 0.2f);
  const Scene scene = acrossThePool(sun);
  expectNear(shaftsOf(scene), across(scene.materials[0], Inside(sun), -1, 1), 0.01);
}

TEST_F(ScatteringGpuTest, IsMissingInTheShadowOfAPlateInTheWater) {
  const vec3 sun(0, -1, 0);
  Scene scene = acrossThePool(sun);
  scene.meshes.push_back(makePlane({0.8f, 3}));
  Object plate;
  plate.mesh = 3;
  plate.material = 1;
  plate.placement.translation = {0.1f, -0.3f, 0};  // from -0.3 to 0.5
  scene.objects.push_back(plate);
  const Inside light(sun);
  const Material& water = scene.materials[0];
  expectNear(shaftsOf(scene), across(water, light, -1, -0.3) + across(water, light, 0.5, 1), 0.04);
}

// Up at an angle past the critical one, and down again to the bed.
TEST_F(ScatteringGpuTest, IsSeenInWhatTheSurfaceReflectsTotally) {
  const vec3 sun(0, -1, 0);
  Scene scene = pool(sun);
  constexpr float kDepth = 0.5f, kSlope = 0.5f;
  scene.camera = {.position = {-1, -kDepth, 0}, .target = {0, kSlope - kDepth, 0}, .verticalFov = 0.5f};
  const Material& water = scene.materials[0];
  const Inside light(sun);
  const double sine = double(kSlope) / std::sqrt(1 + double(kSlope * kSlope));
  const glm::dvec3 extinction(extinctionOf(water));
  glm::dvec3 sum(0);
  constexpr int kSteps = 10000;  // of depth
  for (int i = 0; i < kSteps; ++i) {
    const double depth = (i + 0.5) / kSteps;
    // From there light goes on to the eye by `rise` m of height.
    const auto add = [&](double rise, double cosine) {
      sum += glm::dvec3(water.scattering) * phaseOf(water, cosine) * light.lux *
             glm::exp(-extinction * (depth + rise / sine)) / (kSteps * sine);
    };
    if (depth < double(kDepth)) add(double(kDepth) - depth, sine);
    add(double(kDepth) + depth, -sine);
  }
  expectNear(shaftsOf(scene), sum, 0.01);
}

TEST_F(ScatteringGpuTest, WaterTakesItsPartOfWhatAnEyeInItSees) {
  Scene scene = pool({0, -1, 0});
  scene.lights.clear();
  scene.environment.ambient = vec3(std::numbers::pi_v<float>);
  scene.materials[1].color = vec3(0.5f);
  scene.camera = {.position = {0, -0.25f, 0}, .target = {0, -1, 0}, .up = {0, 0, -1}, .verticalFov = 1};
  const glm::dvec3 left = glm::exp(glm::dvec3(extinctionOf(scene.materials[0])) * -0.75);
  expectNear(shaftsOf(scene, ""), 0.5 * left, 0.002);
}

TEST_F(ScatteringGpuTest, IsLeftToLightVolumes) {
  const Scene scene = pool({0, -1, 0});
  EXPECT_EQ(shaftsOf(scene, "shafts.", "none"), vec3(0));
  // Whose own view goes by slices.
  expectNear(shaftsOf(scene, "shafts.", "adaptive-beams"), glm::dvec3(shaftsOf(scene)), 1e-3);
}

}  // namespace
}  // namespace nephroid
