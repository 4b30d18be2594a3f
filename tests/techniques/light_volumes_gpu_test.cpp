#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/shapes.h"
#include "optics/refraction.h"
#include "support/drawing.h"
#include "support/gpu_fixture.h"
#include "techniques/light_volumes/settings.h"
#include "water/water.h"

namespace nephroid {
namespace {

constexpr float kWaterIndex = 1.33f;
constexpr double kLux = 1000;

// Water over a bed at a depth (m) under the sun.
Scene waterOverBed(Water water, float depth, vec3 sunDirection) {
  Scene scene;
  scene.materials.resize(2);
  scene.materials[0].type = MaterialType::dielectric;
  scene.materials[0].ior = vec3(kWaterIndex);
  scene.meshes = {makeWater(water, 0), makePlane({40, 40})};
  scene.objects.resize(2);
  scene.objects[0].water = std::move(water);
  scene.objects[1].mesh = 1;
  scene.objects[1].material = 1;
  scene.objects[1].placement.translation = {0, -depth, 0};
  Light sun;
  sun.type = LightType::directional;
  sun.direction = normalize(sunDirection);
  sun.illuminance = vec3(float(kLux));
  scene.lights = {sun};
  return scene;
}

class LightVolumesGpuTest : public GpuTest {
 protected:
  std::vector<double> measure(const Scene& scene, const Sensor& sensor,
                              Culling culling = Culling::hierarchical) {
    TechniqueSettings settings = settingsOf(technique);
    settings.own.of<LightVolumeSettings>().culling = culling;
    settings.transport.paths = paths;
    settings.beams.shadowTolerance = shadowTolerance;
    settings.own.of<LightVolumeSettings>().contributionError = contributionError;
    std::vector<double> lux;
    for (const vec3& texel : measuredBy(*chosen, scene, sensor, settings)) lux.push_back(double(texel.y));
    return lux;
  }

  gpu::Device* chosen = &device();
  std::string technique = "light-volumes";
  float shadowTolerance = BeamDivision{}.shadowTolerance;
  float contributionError = 0;
  Paths paths = Paths::transmission;
};

double transmittance(double cosIncident) {
  return 1 - double(fresnelReflectance(float(cosIncident), 1 / kWaterIndex));
}

TEST_F(LightVolumesGpuTest, FlatWaterLetsThroughWhatFresnelSays) {
  Water water;
  water.size = {6, 6};
  water.grid = {60, 60};
  const vec3 sun(0.5f, -1, 0.2f);
  const Sensor sensor{"bed", {-0.5f, -1, -0.5f}, {1, 0, 0}, {0, 0, 1}, {24, 24}};
  const double cosIncident = double(-normalize(sun).y);
  for (const double lux : measure(waterOverBed(water, 1, sun), sensor))
    EXPECT_NEAR(lux, kLux * cosIncident * transmittance(cosIncident), 0.005 * kLux);
}

// Light from above through y = a sin(k x), by where it arrives: the sum over branches of E T |dx / dx'|, as
// the mean over each texel.
std::vector<double> exactUnderSine(double amplitude, double k, double depth, double from, double to,
                                   std::size_t texels) {
  std::vector<double> lux(texels, 0);
  constexpr int kSamples = 2000000;
  const double low = from - 1, high = to + 1, step = (high - low) / kSamples;
  for (int i = 0; i < kSamples; ++i) {
    const double x = low + (i + 0.5) * step;
    const double height = amplitude * std::sin(k * x), slope = amplitude * k * std::cos(k * x);
    const double incident = std::atan(slope), refracted = std::asin(std::sin(incident) / double(kWaterIndex));
    const double arrival = x + (height + depth) * std::tan(incident - refracted);
    const double texel = (arrival - from) / (to - from) * double(texels);
    if (texel >= 0 && texel < double(texels))
      lux[std::size_t(texel)] +=
          kLux * transmittance(std::cos(incident)) * step / ((to - from) / double(texels));
  }
  return lux;
}

double relativeError(const std::vector<double>& lux, const std::vector<double>& exact, double* flux) {
  double sum = 0, exactSum = 0, squares = 0;
  for (std::size_t i = 0; i < lux.size(); ++i) {
    sum += lux[i];
    exactSum += exact[i];
    squares += std::pow(lux[i] - exact[i], 2);
  }
  *flux = sum / exactSum;
  return std::sqrt(squares / double(lux.size())) / (exactSum / double(lux.size()));
}

// Before, at and past the focus, with as many vertices a meter as 200 x 200 on 2 m x 2 m.
TEST_F(LightVolumesGpuTest, ASineFocusesWhereItsMappingSays) {
  Water water;
  water.size = {3, 0.4f};
  const double wavelength = 0.5;
  water.waves = {{0.02f, float(wavelength), {1, 0}, 0, 0}};
  for (const float depth : {0.5f, 0.9f, 1.5f}) {
    const Sensor sensor{"bed", {-0.5f, -depth, -0.05f}, {1, 0, 0}, {0, 0, 0.1f}, {256, 1}};
    const std::vector<double> exact =
        exactUnderSine(0.02, 2 * std::numbers::pi / wavelength, double(depth), -0.5, 0.5, 256);
    double errors[2];
    for (const uint32_t fineness : {1u, 2u}) {
      water.grid = {300 * fineness, 40 * fineness};
      double flux;
      errors[fineness - 1] =
          relativeError(measure(waterOverBed(water, depth, {0, -1, 0}), sensor), exact, &flux);
      EXPECT_NEAR(flux, 1, 0.005) << "depth " << depth;
      EXPECT_LT(errors[fineness - 1], 0.05) << "depth " << depth;
    }
    EXPECT_LT(errors[1], 0.8 * errors[0]) << "depth " << depth;
  }
}

TEST_F(LightVolumesGpuTest, SubgroupsHaveAnySizeThatTheDeviceOffers) {
  Water water;
  water.size = {3, 0.4f};
  water.grid = {300, 40};
  water.waves = {{0.02f, 0.5f, {1, 0}, 0, 0}};
  const Scene scene = waterOverBed(water, 0.9f, {0, -1, 0});
  const Sensor sensor{"bed", {-0.5f, -0.9f, -0.05f}, {1, 0, 0}, {0, 0, 0.1f}, {256, 1}};
  const std::vector<double> exact = exactUnderSine(0.02, 2 * std::numbers::pi / 0.5, 0.9, -0.5, 0.5, 256);
  ASSERT_FALSE(device().info().subgroupSizes.empty());
  for (const uint32_t size : device().info().subgroupSizes) {
    gpu::Device sized({std::to_string(device().info().index), true, {}, size});
    chosen = &sized;
    for (const char* name : {"light-volumes", "illumination-textures"}) {
      technique = name;
      double flux;
      relativeError(measure(scene, sensor), exact, &flux);
      EXPECT_NEAR(flux, 1, 0.005) << name << ", " << size << " threads";
    }
    for (const std::string& message : sized.validationMessages()) ADD_FAILURE() << message;
  }
  EXPECT_THROW(gpu::Device({std::to_string(device().info().index), true, {}, 3}), InputError);
}

Water choppyWater() {
  Water water;
  water.size = {4, 4};
  water.grid = {80, 80};
  water.waves = {{0.02f, 0.7f, {1, 0}, 0, 0}, {0.015f, 0.5f, {-0.3f, 1}, 0, 1}};
  return water;
}

// What two occluders leave that hide each other's part of the water adds up to what there is without any.
TEST_F(LightVolumesGpuTest, HalvesOfTheWaterAddUpToTheWhole) {
  const Sensor sensor{"bed", {-1, -1, -1}, {2, 0, 0}, {0, 0, 2}, {32, 32}};
  const Scene open = waterOverBed(choppyWater(), 1, {0, -1, 0});
  const std::vector<double> whole = measure(open, sensor);
  std::vector<double> sum(whole.size(), 0);
  for (const float side : {-1.0f, 1.0f}) {
    Scene half = open;
    half.meshes.push_back(makeBox({4, 0.1f, 8}));
    Object box;
    box.mesh = 2;
    box.material = 1;
    box.placement.translation = {0.0137f + 2 * side, 1, 0};
    half.objects.push_back(box);
    const std::vector<double> lux = measure(half, sensor);
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += lux[i];
  }
  double flux;
  EXPECT_LT(relativeError(sum, whole, &flux), 0.01);
  EXPECT_NEAR(flux, 1, 1e-3);
}

// Tinted water takes its part of the light on the way to what lies in it (Beer and Lambert).
TEST_F(LightVolumesGpuTest, WaterTakesItsPartByDepth) {
  Water water;
  water.size = {6, 6};
  water.grid = {60, 60};
  Scene scene = waterOverBed(water, 1, {0.5f, -1, 0.2f});
  const Sensor sensor{"bed", {-0.5f, -1, -0.5f}, {1, 0, 0}, {0, 0, 1}, {4, 4}};
  const double clear = measure(scene, sensor)[0];
  scene.materials[0].attenuationColor = vec3(0.6f);
  scene.materials[0].attenuationDistance = 2;
  const double sine = std::sqrt(1 - std::pow(double(scene.lights[0].direction.y), 2)) / double(kWaterIndex);
  const double way = 1 / std::sqrt(1 - sine * sine);
  for (const double lux : measure(scene, sensor)) EXPECT_NEAR(lux / clear, std::pow(0.6, way / 2), 1e-3);
}

// Still water throws the part of the sun that Fresnel says onto a wall above it, as high as the water is
// long.
TEST_F(LightVolumesGpuTest, WaterThrowsLightOntoWallsAboveIt) {
  Water water;
  water.size = {2, 2};
  water.grid = {50, 50};
  const Scene scene = waterOverBed(water, 1, {1, -0.5f, 0});
  paths = Paths::all;
  const double cosIncident = double(-scene.lights[0].direction.y);
  for (const double lux :
       measure(scene, {"wall", {1.5f, 0.9f, -0.3f}, {0, 0, 0.6f}, {0, -0.5f, 0}, {12, 12}}))
    EXPECT_NEAR(lux, kLux * std::sin(std::acos(cosIncident)) * (1 - transmittance(cosIncident)),
                0.005 * kLux);
  for (const double lux : measure(scene, {"above", {1.5f, 1.5f, -0.3f}, {0, 0, 0.6f}, {0, -0.2f, 0}, {4, 4}}))
    EXPECT_EQ(lux, 0);
}

// What changes unevenly from one sixtieth of a second to the next is the light, not the grid.
TEST_F(LightVolumesGpuTest, MovingWaterFlickersNoMoreThanOnAFinerGrid) {
  Water water = choppyWater();
  water.size = {3, 3};
  for (Wave& wave : water.waves) wave.speed = 0.8f;
  const Sensor sensor{"bed", {-0.4f, -1, -0.4f}, {0.8f, 0, 0}, {0, 0, 0.8f}, {32, 32}};
  const auto flicker = [&](uint32_t grid) {
    water.grid = uvec2(grid);
    std::vector<std::vector<double>> frames;
    double sum = 0;
    for (int frame = 0; frame < 5; ++frame) {
      Scene scene = waterOverBed(water, 1, {0.2f, -1, 0.1f});
      scene.meshes[0] = makeWater(water, frame / 60.0);
      frames.push_back(measure(scene, sensor));
      for (std::size_t i = 0; frame >= 2 && i < frames[0].size(); ++i)
        sum += std::abs(frames[std::size_t(frame)][i] - 2 * frames[std::size_t(frame - 1)][i] +
                        frames[std::size_t(frame - 2)][i]);
    }
    return sum;
  };
  EXPECT_LT(flicker(150), 1.1 * flicker(300));
}

// A cell with more of its corners in shadow than the tolerance passes no light; all else passes all of it.
TEST_F(LightVolumesGpuTest, ShadowToleranceLeavesOutCellsMostlyInShadow) {
  const Sensor sensor{"bed", {-1, -1, -1}, {2, 0, 0}, {0, 0, 2}, {32, 32}};
  Scene scene = waterOverBed(choppyWater(), 1, {0, -1, 0});
  scene.meshes.push_back(makeBox({0.8f, 0.1f, 0.8f}));
  Object box;
  box.mesh = 2;
  box.material = 1;
  box.placement.translation = {0.013f, 1, 0.007f};
  box.placement.rotation = glm::angleAxis(0.6f, vec3(0, 1, 0));
  scene.objects.push_back(box);
  const auto fluxAt = [&](float tolerance) {
    shadowTolerance = tolerance;
    double sum = 0;
    for (const double lux : measure(scene, sensor)) sum += lux;
    return sum;
  };
  const double exact = fluxAt(1), usual = fluxAt(0.65f), none = fluxAt(0);
  // The rim of the shadow is 3.2 m of 5 cm cells on 4 m2: 4 %. Of these a part has three dark corners, with
  // an eighth of their light; all of them have one.
  EXPECT_LT(usual, exact);
  EXPECT_GT(usual, exact * (1 - 0.04 / 8));
  EXPECT_LT(none, usual);
  EXPECT_GT(none, exact * (1 - 0.04 * 1.3));
}

TEST_F(LightVolumesGpuTest, NoMoreThanTheContributionErrorIsLeftOut) {
  const Sensor sensor{"bed", {-3, -1, -3}, {6, 0, 0}, {0, 0, 6}, {24, 24}};
  const Scene scene = waterOverBed(choppyWater(), 1, {1, -1, 0.1f});
  const auto sumOf = [&](float part) {
    contributionError = part;
    double sum = 0;
    for (const double lux : measure(scene, sensor)) sum += lux;
    return sum;
  };
  const double whole = sumOf(0);
  for (const float part : {0.01f, 0.2f}) {
    const double kept = sumOf(part) / whole;
    EXPECT_GT(kept, 1 - double(part) - 1e-3);
    EXPECT_LT(kept, 1 - 0.9 * double(part));  // and not much less
  }
}

TEST_F(LightVolumesGpuTest, TheHierarchyChangesNothing) {
  const Sensor sensor{"bed", {-1, -1, -1}, {2, 0, 0}, {0, 0, 2}, {24, 20}};
  const Scene scene = waterOverBed(choppyWater(), 1, {0.3f, -1, 0.1f});
  const std::vector<double> hierarchical = measure(scene, sensor),
                            flat = measure(scene, sensor, Culling::flat);
  // Sums of some tens of floats in another order.
  for (std::size_t i = 0; i < flat.size(); ++i) EXPECT_NEAR(hierarchical[i], flat[i], 1e-5 * kLux);
}

// What stands in the water hides what lies behind it along the refracted light.
// Half a million beams for each of the few pixels: more than a software device goes through at once.
TEST_F(LightVolumesGpuTest, NoBeamOfManyIsLost) {
  Water water;
  water.size = {1, 1};
  water.grid = {500, 500};
  const Sensor sensor{"bed", {-0.49f, -0.1f, -0.49f}, {0.98f, 0, 0}, {0, 0, 0.98f}, {8, 8}};
  for (const double lux : measure(waterOverBed(water, 0.1f, {0, -1, 0}), sensor))
    EXPECT_NEAR(lux, kLux * transmittance(1), 0.005 * kLux);
}

TEST_F(LightVolumesGpuTest, WhatStandsInWaterCastsAShadowAlongTheRefractedLight) {
  Water water;
  water.size = {6, 6};
  water.grid = {120, 120};
  Scene scene = waterOverBed(water, 1, {1, -1, 0});
  scene.meshes.push_back(makeBox({0.4f, 0.02f, 0.4f}));
  Object plate;
  plate.mesh = 2;
  plate.material = 1;
  plate.placement.translation = {0, -0.5f, 0};
  scene.objects.push_back(plate);
  const double tangent = std::tan(std::asin(std::sin(std::numbers::pi / 4) / double(kWaterIndex)));
  const auto shadow = float(0.5 * tangent);  // m, from under the plate's middle
  const auto at = [&](float x) {
    const Sensor sensor{"bed", {x - 0.02f, -1, -0.02f}, {0.04f, 0, 0}, {0, 0, 0.04f}, {2, 2}};
    return measure(scene, sensor)[0];
  };
  EXPECT_EQ(at(shadow), 0);
  const double lit = kLux * std::cos(std::numbers::pi / 4) * transmittance(std::cos(std::numbers::pi / 4));
  EXPECT_NEAR(at(shadow - 0.35f), lit, 0.01 * lit);
  EXPECT_NEAR(at(shadow + 0.35f), lit, 0.01 * lit);
}

}  // namespace
}  // namespace nephroid
