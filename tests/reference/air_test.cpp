// Light scattered once in even air, against integrals along the line of sight.
#include <gtest/gtest.h>

#include <functional>

#include "support/closed_forms.h"
#include "support/reference_scenes.h"

namespace nephroid {
namespace {

constexpr double kExtinction = 0.15, kAlbedo = 0.8;

struct Air {
  PhaseType type;
  double g;
  Medium medium() const {
    return {.extinction = float(kExtinction), .albedo = float(kAlbedo), .phase = type, .g = float(g)};
  }
  // 1/sr by the cosine of the angle that light is turned by.
  double phase(double cosine) const {
    if (type == PhaseType::nishita) return (1 + 9 * std::pow((1 + cosine) / 2, 8)) / (8 * double(kPi));
    return (1 - g * g) / (4 * double(kPi) * std::pow(1 + g * g - 2 * g * cosine, 1.5));
  }
};

constexpr Air kAirs[] = {
    {PhaseType::isotropic, 0}, {PhaseType::henyeyGreenstein, 0.6}, {PhaseType::nishita, 0}};

double integral(double from, double to, const std::function<double(double)>& value) {
  constexpr int kSteps = 100000;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) sum += value(from + (to - from) * (i + 0.5) / kSteps);
  return sum * (to - from) / kSteps;
}

// From the left along +x through the origin: all pixels look along one ray.
Scene lookingAlongX(const Air& air, float distance) {
  Scene scene;
  scene.medium = air.medium();
  scene.camera.position = {-distance, 0, 0};
  scene.camera.target = {0, 0, 0};
  scene.camera.verticalFov = 0.01f;
  return scene;
}

void addWall(Scene& scene, float x, float reflectance = 0) {
  add(scene, makeBox({0.1f, 9, 9}), diffuse(reflectance), {x + 0.05f, 0, 0});
}

// Luminance (nit) scattered toward a camera at `from` by a point light, between two places on the x axis.
double airlight(const Air& air, double candela, glm::dvec3 light, double camera, double from, double to) {
  return integral(from, to, [&](double x) {
    const glm::dvec3 offset = glm::dvec3(x, 0, 0) - light;
    const double distance = length(offset);
    return kExtinction * kAlbedo * air.phase(-offset.x / distance) * candela / (distance * distance) *
           std::exp(-kExtinction * (distance + x - camera));
  });
}

void expectShafts(const Scene& scene, double expected) {
  ReferenceSettings settings;
  settings.size = {64, 64};
  const Image image = seen(scene, 16, settings);
  SampleMean mean;
  for (const float nits : *image.find("shafts.G")) mean.add(double(nits));
  EXPECT_LT(std::abs(mean.mean() - expected), 4 * mean.standardError() + 1e-5 * expected)
      << mean.mean() << ", not " << expected;
  EXPECT_LT(mean.standardError(), 0.01 * expected);
}

TEST(Airlight, OfAPointLightIsItsIntegral) {
  for (const Air& air : kAirs) {
    Scene scene = lookingAlongX(air, 3);
    scene.lights = {pointLight({-0.5f, 0.8f, 0.3f})};
    const glm::dvec3 light(scene.lights[0].position);
    expectShafts(scene, airlight(air, 100, light, -3, -3, 150));
    addWall(scene, 0.2f);
    expectShafts(scene, airlight(air, 100, light, -3, -3, 0.2f));
  }
}

// The angle that the line of sight is seen under from the light is a hundredth of that between its ends.
TEST(Airlight, OfALightBehindTheCameraIsItsIntegral) {
  Scene scene = lookingAlongX(kAirs[0], 3);
  scene.lights = {pointLight({-9, 0.02f, 0})};
  addWall(scene, 1);
  expectShafts(scene, airlight(kAirs[0], 100, {-9, double(0.02f), 0}, -3, -3, 1));
}

TEST(Airlight, OfATubeIsTheMeanOfItsPoints) {
  const Air& air = kAirs[1];
  Scene scene = lookingAlongX(air, 3);
  scene.lights = {lineLight({-1, 1, 0}, {1, 0.5f, 1})};
  addWall(scene, 2);
  const glm::dvec3 from(scene.lights[0].position), to(scene.lights[0].end);
  double expected = 0;
  constexpr int kPoints = 64;
  for (int i = 0; i < kPoints; ++i)
    expected += airlight(air, 100, glm::mix(from, to, (i + 0.5) / kPoints), -3, -3, 2) / kPoints;
  expectShafts(scene, expected);
}

TEST(Airlight, OfTheSunIsItsClosedForm) {
  for (const Air& air : kAirs) {
    Scene scene = lookingAlongX(air, 3);
    scene.lights = {sun({-0.5f, -1, 0.3f})};
    const double cosine = -double(scene.lights[0].direction.x);
    expectShafts(scene, kAlbedo * air.phase(cosine) * 1000);  // the line of sight has no end
    scene.lights = {sun({0.5f, -1, 0.3f})};
    addWall(scene, 2);
    expectShafts(scene, kAlbedo * air.phase(-cosine) * 1000 * -std::expm1(-kExtinction * 5));
  }
}

TEST(Airlight, IsMissingInTheShadowOfAPlate) {
  for (const Air& air : kAirs) {
    Scene scene = lookingAlongX(air, 3);
    scene.lights = {pointLight({0, 2, 0})};
    add(scene, makePlane({0.5f, 4}), diffuse(0.5f), {0.2f, 1, 0});  // from -0.1 to 0.9 on the axis
    addWall(scene, 2);
    const glm::dvec3 light(0, 2, 0);
    expectShafts(scene, airlight(air, 100, light, -3, -3, -0.1) + airlight(air, 100, light, -3, 0.9, 2));
  }
}

TEST(Air, WeakensWhatItLightsAndWhatIsSeen) {
  Scene scene = lookingAlongX(kAirs[0], 3);
  scene.lights = {pointLight({0, 1, 0})};
  addWall(scene, 1, 0.5f);
  ReferenceSettings settings;
  settings.size = {4, 4};
  const Image image = seen(scene, 2, settings);
  const double distance = std::sqrt(2.0);
  const double expected = 0.5 / double(kPi) * 100 / 2 / distance * std::exp(-kExtinction * (distance + 4));
  for (const float nits : *image.find("direct.G")) EXPECT_NEAR(nits, expected, 1e-3 * expected);
}

// Light that falls straight through a pane is as bright in the air below as the pane lets through.
TEST(VolumetricCaustic, OfAPaneIsItsTransmittance) {
  for (const Air& air : {kAirs[0], kAirs[1]}) {
    Scene scene = lookingAlongX(air, 2.5f);
    scene.lights = {sun({0, -1, 0})};
    add(scene, makeBox({2, 0.2f, 3}), glass(), {0, 1, 0});
    addWall(scene, 2.5f);
    scene.camera.verticalFov = 4;
    ReferenceSettings settings;
    settings.size = {8, 8};
    // The few that scatter close to the eye make much of the light: fewer do not tell their own spread.
    settings.photons = 1 << 14;
    const RayScene rays(scene);
    ReferenceImage image(scene, rays, settings);
    const SampleMean shafts = blockMeans(image, {"shafts.G"}, 96, 8).at(0).at(0);

    const auto seenBetween = [](double from, double to) {
      return (std::exp(-kExtinction * (from + 2.5)) - std::exp(-kExtinction * (to + 2.5))) / kExtinction;
    };
    const double face = fresnel(1, 1 / 1.5);
    const double below = (1 - face) / (1 + face) * std::exp(-kExtinction * 0.9);
    const double expected = kExtinction * kAlbedo * air.phase(0) * 1000 *
                            (seenBetween(-2.5, -1) + below * seenBetween(-1, 1) + seenBetween(1, 2.5));
    // Rays two degrees off the axis are longer by a part in two thousand.
    EXPECT_LT(std::abs(shafts.mean() - expected), 4 * shafts.standardError() + 5e-4 * expected)
        << shafts.mean() << ", not " << expected;
    EXPECT_LT(shafts.standardError(), 0.02 * expected);
  }
}

Material turbidWater() {
  Material water = glass(1.33f);
  water.attenuationColor = {0.5f, 0.8f, 0.9f};
  water.attenuationDistance = 1;
  water.scattering = {0.5f, 1, 2};
  water.phase = PhaseType::henyeyGreenstein;
  water.g = 0.4f;
  return water;
}

// Still water, 0.3 m deep, under a vertical sun.
Scene turbidPool(float size) {
  Scene scene;
  Water still;
  still.size = vec2(size);
  add(scene, makeWater(still, 0), turbidWater());
  add(scene, makePlane({2, 2}), diffuse(0), {0, -0.3f, 0});
  scene.lights = {sun({0, -1, 0})};
  return scene;
}

void expectInWater(const Scene& scene, uint32_t photons, glm::dvec3 expected) {
  ReferenceSettings settings;
  settings.size = {8, 8};
  settings.photons = photonsOf(photons);
  settings.spectrum = Spectrum::channels;
  const RayScene rays(scene);
  ReferenceImage image(scene, rays, settings);
  const auto channels = blockMeans(image, {"shafts.R", "shafts.G", "shafts.B"}, 96, 8);
  for (int c = 0; c < 3; ++c) {
    const SampleMean& nits = channels[std::size_t(c)][0];
    // Balls of photons reach out of the water.
    EXPECT_LT(std::abs(nits.mean() - expected[c]), 4 * nits.standardError() + 0.01 * expected[c])
        << nits.mean() << ", not " << expected[c] << " in channel " << c;
    EXPECT_LT(nits.standardError(), standardErrorOf(0.08) * expected[c]);
  }
}

const glm::dvec3 kTurbidScattering(0.5, 1, 2);
const glm::dvec3 kTurbidExtinction = kTurbidScattering - glm::log(glm::dvec3(0.5, 0.8, 0.9));
const Air kTurbid{PhaseType::henyeyGreenstein, 0.4};

TEST(TurbidWater, SeenFromAboveIsItsClosedForm) {
  Scene scene = turbidPool(0.1f);
  scene.camera = {.position = {0, 1, 0}, .target = {0, 0, 0}, .up = {0, 0, -1}, .verticalFov = 0.5f};
  const double through = 1 - fresnel(1, 1 / 1.33);
  const glm::dvec3 both = 2.0 * kTurbidExtinction;
  expectInWater(scene, 1 << 13,
                kTurbidScattering * kTurbid.phase(-1) * 1000.0 * through * through / (1.33 * 1.33) *
                    (1.0 - glm::exp(-both * 0.3)) / both);
}

TEST(TurbidWater, SeenFromWithinIsItsClosedForm) {
  Scene scene = turbidPool(0.3f);
  add(scene, makeBox({0.02f, 0.15f, 0.15f}), diffuse(0), {0.06f, -0.1f, 0});
  scene.camera = {.position = {-0.05f, -0.1f, 0}, .target = {0, -0.1f, 0}, .verticalFov = 10};
  expectInWater(scene, 1 << 15,
                kTurbidScattering * kTurbid.phase(0) * 1000.0 * (1 - fresnel(1, 1 / 1.33)) *
                    glm::exp(-kTurbidExtinction * 0.1) * (1.0 - glm::exp(-kTurbidExtinction * 0.1)) /
                    kTurbidExtinction);
}

}  // namespace
}  // namespace nephroid
