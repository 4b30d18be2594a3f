#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numeric>

#include "geometry/shapes.h"
#include "support/drawing.h"
#include "support/exact_sight.h"
#include "support/gpu_fixture.h"
#include "water/water.h"

namespace nephroid {
namespace {

constexpr uvec2 kSize(320, 240);

void addPlane(Scene& scene, vec3 color, const Placement& placement, vec2 size) {
  scene.materials.push_back({.name = "stripe", .color = color});
  scene.meshes.push_back(makePlane(size));
  scene.objects.push_back({"stripe", uint32_t(scene.meshes.size()) - 1, uint32_t(scene.materials.size()) - 1,
                           placement, std::nullopt});
}

// A floor and a wall of stripes of four colors, and `mesh` of glass half a meter over the floor. Ambient
// light alone.
Scene stripesBehind(Mesh mesh, const Material& material) {
  Scene scene;
  scene.environment.ambient = vec3(std::numbers::pi_v<float>);
  scene.environment.background = vec3(0.15f, 0.2f, 0.3f);
  scene.camera = {.position = {0, 1.2f, 3}, .target = {0, 0.6f, 0}, .verticalFov = 30};
  const vec3 colors[] = {vec3(0.8f, 0.1f, 0.1f), vec3(0.1f, 0.7f, 0.1f), vec3(0.1f, 0.1f, 0.8f), vec3(0.7f)};
  for (int i = 0; i < 12; ++i)
    addPlane(scene, colors[i % 4], {vec3(0, 0, 3.5f - float(i) * 0.5f), quat(1, 0, 0, 0), 1}, {8, 0.5f});
  const quat upright = glm::angleAxis(glm::radians(90.0f), vec3(1, 0, 0));
  for (int i = 0; i < 8; ++i)
    addPlane(scene, colors[(i + 2) % 4], {vec3(-3.5f + float(i), 1, -2.25f), upright, 1}, {1, 2});
  scene.materials.push_back(material);
  scene.meshes.push_back(std::move(mesh));
  scene.objects.push_back({"glass",
                           uint32_t(scene.meshes.size()) - 1,
                           uint32_t(scene.materials.size()) - 1,
                           {vec3(0, 0.7f, 0), quat(1, 0, 0, 0), 1},
                           std::nullopt});
  return scene;
}

Material glass() {
  return {.name = "glass", .type = MaterialType::dielectric};
}

std::vector<vec3> pixelsOf(const Image& image) {
  std::vector<vec3> pixels(std::size_t(image.width) * image.height);
  for (std::size_t i = 0; i < pixels.size(); ++i)
    pixels[i] = {image.find("R")->at(i), image.find("G")->at(i), image.find("B")->at(i)};
  return pixels;
}

float largest(vec3 v) {
  return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

class SightGpuTest : public GpuTest {
 protected:
  std::vector<vec3> drawn(const Scene& scene, SightMethod method, Source source = Source::traced) {
    settings.technique = "none";
    settings.transport.source = source;
    return pixelsOf(Drawing(device(), scene, settings, frameBy(method)).layers(scene));
  }

  static RenderSettings frameBy(SightMethod method, uvec2 size = kSize) {
    return {.size = size, .sight = {.method = method}};
  }

  // Part of the pixels of a disc about the middle of the picture whose color is not to be found, to within a
  // tenth of full reflectance, within two pixels of there in the other picture. The disc's radius: pixels.
  static float strayPart(const std::vector<vec3>& drawn, const std::vector<vec3>& exact, vec2 center,
                         float radius) {
    int all = 0, stray = 0;
    for (int y = int(center.y - radius); float(y) <= center.y + radius; ++y)
      for (int x = int(center.x - radius); float(x) <= center.x + radius; ++x) {
        if (length(vec2(x, y) - center) > radius) continue;
        bool isNear = false;
        for (int dy = -2; dy <= 2; ++dy)
          for (int dx = -2; dx <= 2; ++dx)
            isNear |= largest(drawn[std::size_t(y * int(kSize.x) + x)] -
                              exact[std::size_t((y + dy) * int(kSize.x) + x + dx)]) < 0.1f;
        ++all;
        stray += !isNear;
      }
    return float(stray) / float(all);
  }

  // By rays, and by slices with either source.
  void expectLinedUp(const Scene& scene, vec2 center, float radius) {
    const std::vector<vec3> exact = ExactSight(scene).picture(scene.camera, kSize);
    const auto expectFew = [&](const std::string& name, const std::vector<vec3>& pixels, float most) {
      const float stray = strayPart(pixels, exact, center, radius);
      RecordProperty("stray_pixels_percent_" + name, std::to_string(100 * stray));
      EXPECT_LT(stray, most) << name;
    };
    // Rays show more: what is reflected inside where it could have left. ray_sight_test.cpp has all of it.
    expectFew("rays", drawn(scene, SightMethod::rays), 0.01f);
    for (const Source source : {Source::traced, Source::table})
      expectFew(std::string("slices_") + nameOf(source), drawn(scene, SightMethod::slices, source), 0.005f);
  }

  void expectNoPops(SightMethod method);

  TechniqueSettings settings;
};

// The ball's radius is 76 pixels there.
TEST_F(SightGpuTest, StripesThroughABallLineUpWithThoseTracedForEachPixel) {
  const Scene scene = stripesBehind(makeSphere(0.5f, {.vertices = 6400}), glass());
  expectLinedUp(scene, {160, 111}, 60);
}

TEST_F(SightGpuTest, StripesThroughTheMiddleOfATeapotLineUp) {
  const Scene scene = stripesBehind(makeTeapot(1, {.vertices = 12800}), glass());
  expectLinedUp(scene, {160, 111}, 20);
}

TEST_F(SightGpuTest, AMirrorShowsWhatIsAroundIt) {
  Material mirror{.name = "mirror", .type = MaterialType::mirror, .color = vec3(0.9f)};
  expectLinedUp(stripesBehind(makeSphere(0.5f, {.vertices = 6400}), mirror), {160, 111}, 60);
}

// A pane between the viewer and a ball's caustic, out of the lamp's cone, takes what its two faces reflect at
// incidence near the normal, and nothing else.
TEST_F(SightGpuTest, ACausticThroughAPaneIsAsBrightAsThePaneLetsThrough) {
  Scene scene;
  scene.camera = {.position = {0, 1.5f, 4}, .target = {0, 0, 0}, .verticalFov = 25};
  scene.materials = {{.name = "floor"}, glass()};
  scene.meshes = {makePlane({8, 8}), makeSphere(0.4f, {.vertices = 6400}), makeBox({2, 2, 0.1f})};
  scene.objects = {{"floor", 0, 0, {}, std::nullopt},
                   {"ball", 1, 1, {vec3(0, 1.6f, 0), quat(1, 0, 0, 0), 1}, std::nullopt}};
  Light lamp;
  lamp.type = LightType::spot;
  lamp.position = {0, 4, 0};
  lamp.direction = {0, -1, 0};
  lamp.innerAngle = 14;
  lamp.outerAngle = 15;
  lamp.intensity = vec3(100);
  scene.lights = {lamp};
  const auto causticsOnFloor = [&](SightMethod method) {
    settings.technique = "illumination-textures";
    const Image layers = Drawing(device(), scene, settings, frameBy(method)).layers(scene);
    const std::vector<float>& caustics = *layers.find("caustics.G");
    // The lower part of the picture, where the ball is not.
    return std::accumulate(caustics.begin() + std::ptrdiff_t(kSize.x) * 90, caustics.end(), 0.0);
  };
  const double direct = causticsOnFloor(SightMethod::rays);
  const vec3 toCamera = normalize(scene.camera.position);
  scene.objects.push_back({"pane",
                           2,
                           1,
                           {2.5f * toCamera, glm::angleAxis(-std::atan2(1.5f, 4.0f), vec3(1, 0, 0)), 1},
                           std::nullopt});
  // The floor looks nearer by a third of the pane's thickness, and so larger.
  const double distance = length(scene.camera.position);
  const double magnified = std::pow(distance / (distance - 0.1 * (1 - 1 / 1.5)), 2);
  // The pane's inside sends on once more, by rays, what its two faces reflect.
  for (const SightMethod method : {SightMethod::rays, SightMethod::slices}) {
    const double expected = 0.96 * 0.96 * magnified * (method == SightMethod::rays ? 1 + 0.04 * 0.04 : 1);
    const double through = causticsOnFloor(method) / direct / expected;
    RecordProperty(std::string("through_over_expected_") + nameOf(method), std::to_string(through));
    EXPECT_NEAR(through, 1, 0.01) << nameOf(method);
  }
}

// Straight down into still, tinted water: radiance falls by the square of the index where it leaves, by
// Fresnel, and by the way through the water.
TEST_F(SightGpuTest, WhatLiesUnderWaterIsDimmedByTheSquareOfTheIndexAndByDepth) {
  Scene scene;
  scene.environment.ambient = vec3(std::numbers::pi_v<float>);
  scene.environment.background = vec3(0.25f);
  scene.camera = {.position = {0, 3, 0}, .target = {0, 0, 0}, .up = {0, 0, -1}, .verticalFov = 2};
  Material water = glass();
  water.ior = vec3(1.33f);
  water.attenuationColor = {0.3f, 0.6f, 0.9f};
  water.attenuationDistance = 2;
  scene.materials = {{.name = "floor", .color = vec3(0.5f)}, water};
  scene.meshes = {makePlane({8, 8}), makeWater({{8, 8}, {32, 32}, {}}, 0)};
  scene.objects = {{"floor", 0, 0, {vec3(0, -1, 0), quat(1, 0, 0, 0), 1}, std::nullopt},
                   {"water", 1, 1, {}, std::nullopt}};
  const float reflected = fresnelReflectance(1, 1 / 1.33f);
  const vec3 expected =
      (1 - reflected) * 0.5f / (1.33f * 1.33f) * glm::pow(water.attenuationColor, vec3(0.5f)) +
      reflected * 0.25f;
  for (const SightMethod method : {SightMethod::rays, SightMethod::slices}) {
    const vec3 center = drawn(scene, method)[std::size_t(kSize.x) * (kSize.y / 2) + kSize.x / 2];
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(center[c], expected[c], 2e-3f * expected[c]) << nameOf(method) << c;
  }
}

// Between pictures half a degree apart, all around the glass: no step is larger than the scene's own.
void SightGpuTest::expectNoPops(SightMethod method) {
  constexpr uvec2 kSmall(96, 72);
  constexpr int kPairs = 72;
  Scene scene = stripesBehind(makeSphere(0.5f, {.vertices = 6400}), glass());
  const ExactSight exact(scene);
  settings.technique = "none";
  Drawing drawing(device(), scene, settings, frameBy(method, kSmall));
  const auto step = [](const std::vector<vec3>& a, const std::vector<vec3>& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += largest(a[i] - b[i]);
    return sum / double(a.size());
  };
  double mostMore = 0;
  for (int pair = 0; pair < kPairs; ++pair) {
    std::array<std::vector<vec3>, 2> drawn, traced;
    for (const std::size_t i : {0u, 1u}) {
      const float angle = glm::radians(360.0f * float(pair) / float(kPairs) + 0.5f * float(i));
      scene.camera.position = {3 * std::sin(angle), 1.2f, 3 * std::cos(angle)};
      drawn[i] = pixelsOf(drawing.layers(scene));
      traced[i] = exact.picture(scene.camera, kSmall);
    }
    const double more = step(drawn[0], drawn[1]) - step(traced[0], traced[1]);
    mostMore = std::max(mostMore, more);
    // One pixel in fifty of the ball, which is a tenth of the picture, may fall on the other side of an edge
    // from one stripe to another.
    EXPECT_LT(more, 0.1 * 0.02 * 0.7) << pair;
  }
  RecordProperty("largest_step_beyond_the_traced_nit", std::to_string(mostMore));
}

TEST_F(SightGpuTest, NothingPopsAsTheCameraGoesAround) {
  expectNoPops(SightMethod::rays);
}

TEST_F(SightGpuTest, NothingPopsInSlicesAsTheCameraGoesAround) {
  expectNoPops(SightMethod::slices);
}

}  // namespace
}  // namespace nephroid
