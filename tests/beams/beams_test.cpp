#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>
#include <random>

#include "beams/build.h"
#include "beams/deposit.h"
#include "beams/incident_flux.h"
#include "geometry/shapes.h"
#include "lights/emitters.h"
#include "optics/refraction.h"
#include "render/measure.h"
#include "support/closed_forms.h"
#include "transport/queries.h"
#include "transport/traced/traced_source.h"
#include "water/water.h"

namespace nephroid {
namespace {

constexpr double kPi = std::numbers::pi;

PlaneGrid unitGrid() {
  return {{0, 0, 0}, {1, 0, 0}, {0, 0, 1}, {0, -1, 0}};
}

// A beam that meets the grid's plane, one texel a meter, in these texel coordinates, straight from above.
Beam beamOnto(vec2 a, vec2 b, vec2 c, float flux = 1) {
  Beam beam{};
  const vec2 corners[] = {a, b, c};
  for (int i = 0; i < 3; ++i) {
    beam.position[i] = {corners[i].x, 1, corners[i].y};
    beam.direction[i] = {0, -1, 0};
  }
  beam.flux = vec3(flux);
  return beam;
}

double total(const std::vector<glm::dvec3>& texels) {
  return std::accumulate(texels.begin(), texels.end(), 0.0,
                         [](double sum, const glm::dvec3& t) { return sum + t.x; });
}

TEST(Footprint, LeavesItsWholeFluxWhateverItsSize) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> place(8, 56), unit(-1, 1);
  // Down to a millionth of a texel, where float cannot tell the corners apart any more.
  for (const float size : {30.0f, 3.0f, 1.0f, 0.3f, 1e-2f, 1e-4f, 1e-6f, 0.0f})
    for (int i = 0; i < 200; ++i) {
      const vec2 center(place(random), place(random));
      const auto corner = [&] {
        return glm::clamp(center + size * vec2(unit(random), unit(random)), vec2(0), vec2(63.9f));
      };
      const vec2 a = corner(), b = corner(), c = corner();  // in this order with any compiler
      const Beam beam = beamOnto(a, b, c);
      // Coverage of a triangle no thinner than a sliver has at least four digits.
      EXPECT_NEAR(total(depositFlux({&beam, 1}, unitGrid(), {64, 64})), 1, 2e-4)
          << "size " << size << ", " << i;
    }
}

TEST(Footprint, IsSharedOutByArea) {
  // Right triangle over four texels with the right angle in the middle of the first.
  const Beam beam = beamOnto({10.5f, 20.5f}, {11.5f, 20.5f}, {10.5f, 21.5f});
  const auto texels = depositFlux({&beam, 1}, unitGrid(), {64, 64});
  EXPECT_NEAR(texels[20 * 64 + 10].x, 0.5, 1e-5);
  EXPECT_NEAR(texels[20 * 64 + 11].x, 0.25, 1e-5);
  EXPECT_NEAR(texels[21 * 64 + 10].x, 0.25, 1e-5);
  EXPECT_NEAR(texels[21 * 64 + 11].x, 0, 1e-5);
}

TEST(Footprint, OfAHundredthOfATexelFallsOnTheRightSides) {
  // A quarter of the area lies left of x = 10: similar triangles of half the height.
  const Beam beam = beamOnto({9.998f, 20.5f}, {10.002f, 20.498f}, {10.002f, 20.502f});
  const auto texels = depositFlux({&beam, 1}, unitGrid(), {64, 64});
  EXPECT_NEAR(texels[20 * 64 + 9].x, 0.25, 2e-3);  // float places the corners to 1e-6 of 4e-3
}

TEST(Footprint, ThatIsALineRunsAlongItAsATent) {
  const Beam beam = beamOnto({10, 20.5f}, {14, 20.5f}, {12, 20.5f});
  const auto texels = depositFlux({&beam, 1}, unitGrid(), {64, 64});
  const double expected[] = {0.125, 0.375, 0.375, 0.125};
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(texels[20 * 64 + 10 + i].x, expected[i], 1e-5);
}

TEST(Flux, OfAPointLightOntoAClosedMeshIsItsIntensityTimesFourPi) {
  const Mesh sphere = makeSphere(1, {.segments = 20});
  Emitter inside{};
  inside.type = kEmitterPoint;
  inside.position = {0.2f, -0.3f, 0.1f};
  inside.power = vec3(10);
  double flux = 0;
  for (const uvec3& t : sphere.triangles)
    flux -=
        double(fluxOnto({}, inside, sphere.positions[t.x], sphere.positions[t.y], sphere.positions[t.z]).x);
  EXPECT_NEAR(flux, 40 * kPi, 40 * kPi * 1e-5);
}

// Onto triangles far larger than the gobo's texels and the cone's edge.
TEST(Flux, OfAGoboOntoAClosedMeshIsItsIntensityOverAllDirections) {
  const Mesh sphere = makeSphere(1, {.segments = 40});
  Scene scene;
  std::mt19937 random(3);
  std::uniform_real_distribution<float> level(0, 1);
  Texture gobo{"noise", 60, 60, {}};
  for (int i = 0; i < 3600; ++i) gobo.texels.emplace_back(vec3(level(random)), 1);
  scene.textures.push_back(gobo);
  Light light;
  light.type = LightType::spot;
  light.position = {0.2f, -0.1f, 0.1f};
  light.direction = normalize(vec3(1, 2, -3));
  light.intensity = vec3(10);
  light.goboTexture = 0;
  light.innerAngle = 38;
  light.outerAngle = 40;
  const ShapedLight shaped = shapedLight(scene, light);
  const Emitter emitter = emittersOf(light).front();
  double flux = 0;
  for (const uvec3& t : sphere.triangles)
    flux -= double(
        fluxOnto(shaped, emitter, sphere.positions[t.x], sphere.positions[t.y], sphere.positions[t.z]).x);
  constexpr int kSteps = 1000;
  const double least = std::cos(glm::radians(40.0));  // of the cosine from the axis
  double expected = 0;
  for (int i = 0; i < kSteps * kSteps; ++i) {
    const double z = glm::mix(least, 1.0, (i % kSteps + 0.5) / kSteps),
                 around = 2 * kPi * (i / kSteps) / kSteps;
    const double aside = std::sqrt(1 - z * z);
    const vec3 direction = float(aside * std::cos(around)) * shaped.frame.right +
                           float(aside * std::sin(around)) * shaped.frame.up +
                           float(z) * shaped.frame.forward;
    expected += double(lightIntensity(shaped, direction).x) * 2 * kPi * (1 - least) / (kSteps * kSteps);
  }
  EXPECT_NEAR(flux, expected, 1e-3 * expected);
}

struct Arrangement {
  Scene scene;
  Sensor sensor;
};

// A caster above a floor at y = 0 under a sun of 1000 lux, and a sensor of 2 m on the floor.
Arrangement underTheSun(Mesh caster, float height, vec3 sun = {0, -1, 0}, float ior = 1.5f) {
  Arrangement setup;
  Scene& scene = setup.scene;
  scene.materials.resize(2);
  scene.materials[0].type = MaterialType::dielectric;
  scene.materials[0].ior = vec3(ior);
  scene.meshes = {std::move(caster), makePlane({20, 20})};
  scene.objects.resize(2);
  scene.objects[0].placement.translation = {0, height, 0};
  scene.objects[1].mesh = 1;
  scene.objects[1].material = 1;
  Light light;
  light.type = LightType::directional;
  light.direction = glm::normalize(sun);
  light.illuminance = vec3(1000);
  scene.lights = {light};
  setup.sensor = {"floor", {-1, 0, -1}, {2, 0, 0}, {0, 0, 2}, {128, 128}};
  return setup;
}

SensorLayer causticsOf(const Arrangement& setup, Paths paths = Paths::transmission) {
  const RayScene rays(setup.scene);
  const TracedSource source(setup.scene, rays);
  Progress progress;
  Stats stats;
  return measureBeams(setup.scene, rays, source, setup.sensor, paths, 3, progress, stats);
}

double fluxOf(const Arrangement& setup, const SensorLayer& layer) {
  double sum = 0;
  for (const vec3& lux : layer) sum += double(lux.y);
  return sum * double(length(cross(setup.sensor.u, setup.sensor.v))) / double(layer.size());
}

TEST(Beams, ThroughAPlateCarryWhatTwoFacesLetThrough) {
  const Arrangement setup = underTheSun(makeBox({1, 0.2f, 1}), 0.5f);
  // At its rim a leaf of the mesh, 1/32 of a side cut in 8, may go astray: 4 sides of 1/256.
  EXPECT_NEAR(fluxOf(setup, causticsOf(setup)), 1000 * 0.96 * 0.96, 1000 * 4.0 / 256);
}

TEST(Beams, ThroughATiltedPlateAreShiftedAsSnellSays) {
  const vec3 sun = glm::normalize(vec3(1, -1, 0));
  const Arrangement setup = underTheSun(makeBox({1, 0.2f, 1}), 0.5f, sun);
  const SensorLayer layer = causticsOf(setup);
  // Where the middle of the light lands that enters the top and leaves the bottom.
  const double inside = std::asin(std::sin(kPi / 4) / 1.5);
  const double shift = 0.2 * std::tan(inside);
  // Entry points whose exit lies on the bottom: x in [-0.5, 0.5 - shift]; from y = 0.4 on they travel as they
  // came.
  const double x = -shift / 2 + shift + 0.4;
  const double reflectance = double(fresnelReflectance(float(std::cos(kPi / 4)), 1 / 1.5f));
  const double expectedLux = 1000 * std::cos(kPi / 4) * (1 - reflectance) * (1 - reflectance);
  const auto column = std::size_t((x + 1) / 2 * 128);
  EXPECT_NEAR(layer[64 * 128 + column].y, expectedLux, 0.01 * expectedLux);
}

TEST(Beams, ThroughFlatOpenWaterKeepTheCosineAndTheTransmittance) {
  Water water;
  water.size = {8, 8};
  water.grid = {64, 64};
  const vec3 sun = glm::normalize(vec3(0.4f, -1, 0.2f));
  Arrangement setup = underTheSun(makeWater(water, 0), 1, sun, 1.33f);
  setup.sensor.corner = {-0.5f, 0, -0.5f};
  setup.sensor.u = {1, 0, 0};
  setup.sensor.v = {0, 0, 1};
  const double cosine = -double(sun.y);
  const double expected = 1000 * cosine * (1 - double(fresnelReflectance(float(cosine), 1 / 1.33f)));
  for (const vec3& lux : causticsOf(setup)) ASSERT_NEAR(lux.y, expected, 0.005 * expected);
}

TEST(Beams, OfABallMatchTheClosedFormBeforeInAndPastTheFocus) {
  for (const float height : {0.6f, 0.9f, 1.2f}) {
    constexpr std::size_t kRings = 32;
    const double ringWidth = 0.5 / kRings;
    std::vector<double> flux = ballLensRings(0.5, double(height), 1.5, ringWidth, kRings);
    for (double& lumens : flux) lumens *= 1000;
    Arrangement setup = underTheSun(makeSphere(0.5f, {.vertices = 25600}), height);
    setup.sensor = {"floor", {-0.5f, 0, -0.5f}, {1, 0, 0}, {0, 0, 1}, {512, 512}};
    const SensorLayer layer = causticsOf(setup);
    std::vector<double> measured(kRings, 0.0);
    const double texelArea = 1.0 / (512.0 * 512.0);
    for (int y = 0; y < 512; ++y)
      for (int x = 0; x < 512; ++x) {
        const auto ring = std::size_t(std::hypot((x + 0.5) / 512 - 0.5, (y + 0.5) / 512 - 0.5) / ringWidth);
        if (ring < measured.size())
          measured[ring] += double(layer[std::size_t(y) * 512 + std::size_t(x)].y) * texelArea;
      }
    const double all = std::accumulate(flux.begin(), flux.end(), 0.0);
    EXPECT_NEAR(std::accumulate(measured.begin(), measured.end(), 0.0), all, 0.005 * all)
        << "height " << height;
    // A texel is an eighth of a ring: what straddles two rings is told apart only so far.
    for (std::size_t ring = 0; ring < kRings; ++ring)
      EXPECT_NEAR(measured[ring], flux[ring], 0.04 * flux[ring] + 0.004 * all)
          << "height " << height << ", ring " << ring;
  }
}

TEST(Beams, OfALightInsideTheGlassComeOut) {
  Arrangement setup = underTheSun(makeSphere(0.5f, {.vertices = 6400}), 1);
  Light& light = setup.scene.lights[0];
  light.type = LightType::point;
  light.position = {0, 1, 0};
  light.intensity = vec3(100);
  // From the center no ray is bent: E = I cos^3 / h^2 times the transmittance at normal incidence.
  const SensorLayer layer = causticsOf(setup);
  EXPECT_NEAR(layer[64 * 128 + 64].y, 96, 1);
}

TEST(Beams, AreTheSameWhateverTheOrderOfThreads) {
  const Arrangement setup = underTheSun(makeTorus(0.4f, 0.15f, {.vertices = 2000}), 0.8f, {0.3f, -1, 0.1f});
  const SensorLayer first = causticsOf(setup), second = causticsOf(setup);
  EXPECT_EQ(first, second);
}

TEST(Beams, OfAnOccludedCasterCarryNothing) {
  Arrangement setup = underTheSun(makeSphere(0.3f, {.vertices = 1000}), 0.5f);
  Object roof = setup.scene.objects[1];
  roof.placement.translation = {0, 2, 0};
  setup.scene.objects.push_back(roof);
  EXPECT_EQ(fluxOf(setup, causticsOf(setup)), 0);
}

}  // namespace
}  // namespace nephroid
