#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "exact_sight.h"
#include "gpu_fixture.h"
#include "render/frame.h"
#include "scene/shapes.h"
#include "techniques/registry.h"

namespace nephroid {
namespace {

constexpr uvec2 kSize(320, 240);

void addPlane(Scene& scene, vec3 color, const Placement& placement, vec2 size) {
  scene.materials.push_back({.name = "stripe", .color = color});
  scene.meshes.push_back(makePlane(size));
  scene.objects.push_back({"stripe", uint32_t(scene.meshes.size()) - 1, uint32_t(scene.materials.size()) - 1,
                           placement, std::nullopt});
}

// A floor and a wall of stripes of four colours, and `mesh` of glass half a metre over the floor. Ambient
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
  std::vector<vec3> drawn(const Scene& scene, Source source, uvec2 size = kSize) {
    settings.technique = "none";
    settings.source = source;
    Progress progress;
    Stats stats;
    SceneTransport transport(scene, settings, progress);
    const auto technique = makeTechnique({device(), settings, transport, stats});
    Renderer renderer(device(), transport, {.size = size}, *technique);
    renderer.render(scene);
    return pixelsOf(renderer.layers());
  }

  // Part of the pixels of a disc about the middle of the picture whose colour is not to be found, to within a
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

  void expectLinedUp(const Scene& scene, Source source, vec2 center, float radius) {
    const std::vector<vec3> exact = ExactSight(scene).picture(scene.camera, kSize);
    const float stray = strayPart(drawn(scene, source), exact, center, radius);
    RecordProperty(std::string("stray_pixels_percent_") + nameOf(source), std::to_string(100 * stray));
    EXPECT_LT(stray, 0.005f);
  }

  TechniqueSettings settings;
};

// The ball's radius is 76 pixels there.
TEST_F(SightGpuTest, StripesThroughABallLineUpWithThoseTracedForEachPixel) {
  const Scene scene = stripesBehind(makeSphere(0.5f, {.vertices = 6400}), glass());
  expectLinedUp(scene, Source::traced, {160, 111}, 60);
  expectLinedUp(scene, Source::table, {160, 111}, 60);
}

TEST_F(SightGpuTest, StripesThroughTheMiddleOfATeapotLineUp) {
  const Scene scene = stripesBehind(makeTeapot(1, {.vertices = 12800}), glass());
  expectLinedUp(scene, Source::traced, {160, 111}, 20);
  expectLinedUp(scene, Source::table, {160, 111}, 20);
}

TEST_F(SightGpuTest, AMirrorShowsWhatIsAroundIt) {
  Material mirror{.name = "mirror", .type = MaterialType::mirror, .color = vec3(0.9f)};
  expectLinedUp(stripesBehind(makeSphere(0.5f, {.vertices = 6400}), mirror), Source::traced, {160, 111}, 60);
}

// The largest step between pictures half a degree apart is that of the scene, not of slices that come and go.
TEST_F(SightGpuTest, NothingPopsAsTheCameraGoesAround) {
  constexpr uvec2 kSmall(160, 120);
  constexpr int kFrames = 36;
  Scene scene = stripesBehind(makeSphere(0.5f, {.vertices = 6400}), glass());
  const ExactSight exact(scene);
  settings.technique = "none";
  Progress progress;
  Stats stats;
  SceneTransport transport(scene, settings, progress);
  const auto technique = makeTechnique({device(), settings, transport, stats});
  Renderer renderer(device(), transport, {.size = kSmall}, *technique);
  const auto step = [](const std::vector<vec3>& a, const std::vector<vec3>& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += largest(a[i] - b[i]);
    return sum / double(a.size());
  };
  std::vector<vec3> before, exactBefore;
  double most = 0, exactMost = 0;
  for (int frame = 0; frame < kFrames; ++frame) {
    const float angle = glm::radians(0.5f * float(frame));
    scene.camera.position = {3 * std::sin(angle), 1.2f, 3 * std::cos(angle)};
    renderer.render(scene);
    const std::vector<vec3> now = pixelsOf(renderer.layers());
    const std::vector<vec3> exactNow = exact.picture(scene.camera, kSmall);
    if (frame > 0) {
      most = std::max(most, step(before, now));
      exactMost = std::max(exactMost, step(exactBefore, exactNow));
    }
    before = now;
    exactBefore = exactNow;
  }
  RecordProperty("largest_step_nit", std::to_string(most));
  RecordProperty("largest_exact_step_nit", std::to_string(exactMost));
  // A pixel in a hundred may step by a twentieth more on either side of an edge that is two pixels off.
  EXPECT_LT(most, exactMost + 0.01 * 0.05);
}

}  // namespace
}  // namespace nephroid
