// Shafts of light as the frame draws them, against integrals along the ray of each pixel.
#include <cmath>
#include <functional>
#include <random>

#include "lights/light_intensity.h"
#include "scene/air.h"
#include "support/drawing.h"
#include "support/gpu_fixture.h"
#include "support/reference_scenes.h"

namespace nephroid {
namespace {

constexpr uvec2 kSize(96, 64);
constexpr std::size_t kPixelStep = 37;  // pixels that are looked at

class ShaftsOfLight : public GpuTest {
 protected:
  // All frames of one renderer; the layers of the last.
  Image drawn(const std::vector<Scene>& frames, const ShaftSettings& shafts = {}, uvec2 size = kSize) {
    Drawing drawing(device(), frames.front(), settingsOf("none"),
                    {.size = size, .shadowMapSize = 1024, .shafts = shafts});
    for (const Scene& scene : frames) drawing.renderer.render(scene);
    planes_ = drawing.renderer.shafts().planes();
    return drawing.renderer.layers();
  }
  std::vector<AirPlanes> planes_;
};

// The ray through the middle of a pixel.
vec3 directionOf(const Camera& camera, std::size_t pixel, uvec2 size) {
  const vec3 forward = normalize(camera.target - camera.position);
  const vec3 right = normalize(cross(forward, camera.up)), up = cross(right, forward);
  const vec2 place = (vec2(pixel % size.x, pixel / size.x) + 0.5f) / vec2(size) * 2.0f - 1.0f;
  const float tangent = std::tan(glm::radians(camera.verticalFov / 2));
  return normalize(forward + tangent * (place.x * float(size.x) / float(size.y) * right - place.y * up));
}

// Whether light comes to a point.
using IsLit = std::function<bool(glm::dvec3)>;
bool always(glm::dvec3) {
  return true;
}

// nit scattered by `light` along a ray of `length` (m), with steps as even as the light sees them.
double airlight(const Scene& scene, const Light& light, glm::dvec3 eye, glm::dvec3 direction, double length,
                const IsLit& isLit = always) {
  constexpr int kSteps = 1500;
  const Medium& air = *scene.medium;
  const ShapedLight shaped = shapedLight(scene, light);
  const bool isFar = light.type == LightType::directional;
  const glm::dvec3 lamp(light.position);
  const double closest = dot(lamp - eye, direction),
               height = std::max(distance(lamp, eye + closest * direction), 1e-6);
  const double from = std::atan(-closest / height), to = std::atan((length - closest) / height);
  const auto densityAt = [&](glm::dvec3 p) { return double(fogDensity(airOf(air), float(p.y))); };
  const auto depthBetween = [&](glm::dvec3 a, glm::dvec3 b) {
    if (air.grid) return double(opticalDepth(air, vec3(a), vec3(normalize(b - a)), float(distance(a, b))));
    if (air.fogHeight <= 0) return double(air.extinction) * distance(a, b);
    double sum = 0;
    for (int i = 0; i < 64; ++i) sum += densityAt(glm::mix(a, b, (i + 0.5) / 64)) / 64;
    return double(air.extinction) * distance(a, b) * sum;
  };
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double part = (i + 0.5) / kSteps;
    const double along = isFar ? part * length : closest + height * std::tan(glm::mix(from, to, part));
    const glm::dvec3 point = eye + along * direction;
    if (!isLit(point)) continue;
    const glm::dvec3 way = isFar ? glm::dvec3(light.direction) : normalize(point - lamp);
    const double lux = isFar ? double(light.illuminance.y)
                             : double(lightIntensity(shaped, vec3(way)).y) / dot(point - lamp, point - lamp);
    const double step =
        isFar ? length / kSteps : (to - from) / kSteps * dot(point - lamp, point - lamp) / height;
    const double depth = depthBetween(eye, point) + (isFar ? 0 : depthBetween(lamp, point));
    const double scattering = air.grid ? double(scatteringAt(air, vec3(point)))
                                       : double(air.extinction * air.albedo) * densityAt(point);
    sum += lux * scattering * double(phaseOf(air, float(-dot(way, direction)))) * std::exp(-depth) * step;
  }
  return sum;
}

Scene smoke(PhaseType phase, float g = 0) {
  Scene scene;
  scene.camera.position = {0, 0, 5};
  scene.camera.target = {0, 0, 0};
  scene.medium = Medium{};
  scene.medium->extinction = 0.15f;
  scene.medium->albedo = 0.8f;
  scene.medium->phase = phase;
  scene.medium->g = g;
  return scene;
}

const std::vector<Medium> kAirs{*smoke(PhaseType::isotropic).medium, *smoke(PhaseType::nishita).medium,
                                *smoke(PhaseType::henyeyGreenstein, 0.6f).medium};

// Each pixel that is not nearly dark to within `tolerance`.
void expectAirlight(const Scene& scene, const Image& image, double length, double tolerance,
                    const IsLit& isLit = always, double toleranceOfPeak = 1e-5) {
  const std::vector<float>& shafts = *image.find("shafts.G");
  std::vector<double> expected;
  double peak = 0;
  for (std::size_t i = 0; i < shafts.size(); i += kPixelStep) {
    double sum = 0;
    for (const Light& light : scene.lights)
      sum +=
          airlight(scene, light, scene.camera.position, directionOf(scene.camera, i, kSize), length, isLit);
    expected.push_back(sum);
    peak = std::max(peak, sum);
  }
  ASSERT_GT(peak, 0);
  for (std::size_t i = 0; i < expected.size(); ++i)
    ASSERT_NEAR(shafts[kPixelStep * i], expected[i], tolerance * expected[i] + toleranceOfPeak * peak)
        << "pixel " << kPixelStep * i % kSize.x << ", " << kPixelStep * i / kSize.x;
}

TEST_F(ShaftsOfLight, OfAnUnshadowedConeAreTheirIntegralInEachPhaseFunction) {
  for (const Medium& air : kAirs) {
    Scene scene = smoke(PhaseType::isotropic);
    scene.medium = air;
    scene.lights = {spotLight({-1.5f, 1.2f, 0.4f}, {0.5f, -0.3f, -0.2f}, 12, 18)};
    expectAirlight(scene, drawn({scene}), 500, 0.01);
    scene.lights = {spotLight({0.3f, 0.2f, 7}, {0, 0, 0}, 20, 40)};  // from behind, the eye in the cone
    expectAirlight(scene, drawn({scene}), 500, 0.01);
    scene.lights = {spotLight({0.4f, 0.3f, -3}, {0, 0, 4}, 0, 30)};  // against the eye
    expectAirlight(scene, drawn({scene}), 500, 0.01);
  }
}

TEST_F(ShaftsOfLight, OfAPointALineAndTheSunAreTheirIntegrals) {
  for (const Medium& air : kAirs) {
    Scene scene = smoke(PhaseType::isotropic);
    scene.medium = air;
    scene.lights = {pointLight({0.7f, 0.4f, -1})};
    expectAirlight(scene, drawn({scene}), 500, 0.01);
    scene.lights = {sun({0.3f, -1, 0.6f})};
    expectAirlight(scene, drawn({scene}), 100, 0.01);
  }
  Scene scene = smoke(PhaseType::nishita);
  scene.lights = {lineLight({-1, 0.5f, 0}, {1, 0.6f, 0.5f})};
  const Image image = drawn({scene});
  scene.lights.clear();
  for (const Emitter& point : emittersOf(lineLight({-1, 0.5f, 0}, {1, 0.6f, 0.5f})))
    scene.lights.push_back(pointLight(point.position, point.power.x));
  expectAirlight(scene, image, 500, 0.01);
}

TEST_F(ShaftsOfLight, InFogThatThinsOutAreTheirIntegral) {
  Scene scene = smoke(PhaseType::henyeyGreenstein, 0.4f);
  scene.medium->fogBase = -0.5f;
  scene.medium->fogHeight = 0.7f;
  scene.lights = {spotLight({-1.5f, 1.2f, 0.4f}, {0.5f, -0.6f, -0.2f}, 12, 18), pointLight({1, -1, -1}, 20)};
  expectAirlight(scene, drawn({scene}), 60, 0.01);
}

TEST_F(ShaftsOfLight, InCloudsAreTheirIntegral) {
  Scene scene = smoke(PhaseType::nishita);
  scene.medium->extinction = 0.5f;
  scene.medium->grid = DensityGrid{"noise", {-1.5f, -1, -1}, {3, 2, 2}, {24, 16, 16}, {}};
  fillWithNoise(*scene.medium->grid, {.feature = 1, .octaves = 2, .seed = 5, .clear = 0.2f});
  scene.lights = {spotLight({-1.8f, 1.2f, 0.4f}, {0.5f, -0.3f, -0.2f}, 12, 18), sun({0.2f, -1, 0}, 3)};
  // The depths between nodes of the box are interpolated.
  expectAirlight(scene, drawn({scene}, {.error = 0.001f}), 9, 0.02, always, 0.003);
}

TEST_F(ShaftsOfLight, BehindAPlateAreItsIntegralWithoutTheShadow) {
  Scene scene = smoke(PhaseType::isotropic);
  scene.camera.position = {0, 0, 5};
  scene.lights = {pointLight({0, 3, 0})};
  add(scene, makePlane({0.8f, 2}), diffuse(0.5f), {0.3f, 2.5f, 0});  // above what is seen
  const Image image = drawn({scene}, {.error = 0.001f});
  const auto isLit = [](glm::dvec3 p) {
    const double part = 0.5 / (3 - p.y);  // of the way from the light, where it crosses the plate
    const double x = part * p.x, z = part * p.z;
    return part > 1 || p.y > 3 || std::abs(x - 0.3) > 0.4 || std::abs(z) > 1;
  };
  expectAirlight(scene, image, 500, 0.03, isLit);  // a texel of the shadow map may be lit or not
}

// With a receiver in front of the eye, light ends there, and what is seen of it is weakened.
TEST_F(ShaftsOfLight, EndAtAWallWhichTheAirDims) {
  Scene scene = smoke(PhaseType::isotropic);
  Object& wall = add(scene, makePlane({40, 40}), diffuse(0.5f), {0, 0, -1});
  wall.placement.rotation = glm::angleAxis(glm::radians(90.0f), vec3(1, 0, 0));
  scene.lights = {pointLight({0.4f, 0.3f, 1})};
  const Image image = drawn({scene});
  const std::size_t middle = std::size_t(kSize.y / 2) * kSize.x + kSize.x / 2;
  const glm::dvec3 eye(scene.camera.position), direction(directionOf(scene.camera, middle, kSize));
  const double length = 6 / -direction.z;
  EXPECT_NEAR(image.find("shafts.G")->at(middle), airlight(scene, scene.lights[0], eye, direction, length),
              0.005 * image.find("shafts.G")->at(middle));
  const glm::dvec3 offset = eye + length * direction - glm::dvec3(scene.lights[0].position);
  const double away = glm::length(offset);
  const double expected =
      0.5 / double(kPi) * 100 * 2 / (away * away * away) * std::exp(-0.15 * (away + length));
  EXPECT_NEAR(image.find("direct.G")->at(middle), expected, 1e-3 * expected);
  EXPECT_NEAR(image.find("G")->at(middle),
              image.find("direct.G")->at(middle) + image.find("shafts.G")->at(middle), 1e-5);
}

// A shadow's edge that sweeps slantwise over the picture: what planes miss does not jump from pixel to pixel.
TEST_F(ShaftsOfLight, HaveNoBandsAtAShadowsEdge) {
  Scene scene = smoke(PhaseType::isotropic);
  scene.lights = {pointLight({0, 3, 0})};
  add(scene, makePlane({4, 1.5f}), diffuse(0.5f), {-2.2f, 2.6f, -0.3f});
  constexpr uvec2 size(256, 64);
  const Image image = drawn({scene}, {.planes = 64}, size);
  const Image converged = drawn({scene}, {.planes = 1500, .subplanes = 1}, size);
  const float* shafts = image.find("shafts.G")->data();
  const float* right = converged.find("shafts.G")->data();
  double steps = 0, contrast = 0;
  for (std::size_t y = 0; y < size.y; ++y)
    for (std::size_t x = 1; x < size.x; ++x) {
      const std::size_t i = y * size.x + x;
      steps = std::max(steps, double(std::abs((shafts[i] - right[i]) - (shafts[i - 1] - right[i - 1]))));
      contrast = std::max(contrast, double(right[i]));
    }
  // Paper 4's 30 planes without sub-planes have steps of 0.03.
  EXPECT_LT(steps, 0.008 * contrast);
}

TEST_F(ShaftsOfLight, OfALightThatIsSwitchedOffAreGoneInTheNextFrame) {
  Scene on = smoke(PhaseType::nishita);
  on.lights = {spotLight({-1.5f, 1.2f, 0.4f}, {0.5f, -0.3f, -0.2f}, 12, 18)};
  Scene off = on;
  off.lights[0].intensity = vec3(0);
  const Image image = drawn({on, on, off});
  for (const float nits : *image.find("shafts.G")) ASSERT_EQ(nits, 0);
  EXPECT_GT(drawn({off, on}).find("shafts.G")->at(kSize.x * kSize.y / 2 + kSize.x / 2), 0);
}

TEST_F(ShaftsOfLight, TakeMorePlanesForALesserError) {
  Scene scene = smoke(PhaseType::henyeyGreenstein, 0.95f);
  scene.lights = {pointLight({0.7f, 0.4f, -1})};
  drawn({scene}, {.error = 0.1f});
  const uint32_t few = planes_.at(0).planes;
  drawn({scene}, {.error = 0.0005f});
  EXPECT_GT(planes_.at(0).planes, few);
  drawn({scene}, {.planes = 11, .subplanes = 3});
  EXPECT_EQ(planes_.at(0).planes, 11u);
  EXPECT_EQ(planes_.at(0).subplanes, 3u);
}

}  // namespace
}  // namespace nephroid
