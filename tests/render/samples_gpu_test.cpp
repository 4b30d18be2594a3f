// Pictures of several samples of each pixel.
#include <algorithm>
#include <cmath>

#include "core/pixel_filter.h"
#include "geometry/shapes.h"
#include "render/view.h"
#include "support/drawing.h"
#include "support/gpu_fixture.h"

namespace nephroid {
namespace {

constexpr uvec2 kSize(64, 48);

class Samples : public GpuTest {
 protected:
  struct Sampled : Drawing {
    Sampled(const Scene& scene, const std::string& name, uint32_t samples)
        : Drawing(device(), scene, settingsOf(name),
                  {.size = kSize, .shadowMapSize = 256, .samples = samples}) {}
  };
};

// A shining half plane seen from straight above it: white up to its edge, and black beyond.
struct HalfPlane {
  Scene scene;
  vec2 onEdge{0}, inward{0};  // pixels

  HalfPlane(float angle, float offset) {
    constexpr float kSide = 40;
    scene.camera.position = {0, 5, 0};
    scene.camera.target = {0, 0, 0};
    scene.camera.verticalFov = 40;
    scene.environment.background = vec3(0);
    scene.materials.resize(1);
    scene.materials[0].color = vec3(0);
    scene.materials[0].emission = vec3(1);
    scene.meshes = {makePlane({kSide, kSide})};
    scene.objects.resize(1);
    const vec3 away(std::cos(angle), 0, -std::sin(angle)), along(std::sin(angle), 0, std::cos(angle));
    scene.objects[0] = {
        "plane", 0, 0, {(0.5f * kSide + offset) * away, glm::angleAxis(angle, vec3(0, 1, 0)), 1}};
    const View view = viewOf(scene.camera, kSize);
    const auto pixel = [&](vec3 point) {
      const vec4 clip = view.worldToClip * vec4(point, 1);
      return (0.5f * vec2(clip) / clip.w + 0.5f) * vec2(kSize);
    };
    onEdge = pixel(offset * away);
    const vec2 edge = pixel(offset * away + along) - onEdge;
    inward = normalize(vec2(-edge.y, edge.x));
    if (dot(inward, pixel((offset + 1) * away) - onEdge) < 0) inward = -inward;
  }

  // The part of the filter about this place (pixels) that is on the plane.
  double coverage(vec2 place) const {
    constexpr int kSteps = 96;
    static const std::vector<float> kOffsets = [] {
      std::vector<float> offsets;
      for (int i = 0; i < kSteps; ++i) offsets.push_back(float(filteredOffset((i + 0.5) / kSteps)));
      return offsets;
    }();
    int inside = 0;
    for (const float x : kOffsets)
      for (const float y : kOffsets) inside += dot(place + vec2(x, y) - onEdge, inward) > 0;
    return double(inside) / (kSteps * kSteps);
  }
};

// With one sample in each of N squares, of which an edge crosses at most 2 sqrt(N) - 1, the error is at most
// that of stratified sampling: variance (2 sqrt(N) - 1) / 4 / N^2.
TEST_F(Samples, CoverAnEdgeAsItsFilterDoes) {
  for (const uint32_t samples : {16u, 64u}) {
    double square = 0, largest = 0;
    int crossed = 0;
    for (const auto& [angle, offset] : {std::pair(0.1f, 0.0f), {0.7f, 0.03f}, {1.2f, -0.2f}, {2.5f, 0.11f}}) {
      const HalfPlane plane(angle, offset);
      Sampled drawing(plane.scene, "none", samples);
      const Image layers = drawing.layers(plane.scene);
      const std::vector<float>& red = *layers.find("R");
      for (uint32_t y = 0; y < kSize.y; ++y)
        for (uint32_t x = 0; x < kSize.x; ++x) {
          const vec2 place(float(x) + 0.5f, float(y) + 0.5f);
          const double exact = plane.coverage(place), error = std::abs(double(red[y * kSize.x + x]) - exact);
          if (exact == 0 || exact == 1) {
            EXPECT_LT(error, 1e-6);
            continue;
          }
          ++crossed;
          square += error * error;
          largest = std::max(largest, error);
        }
    }
    const double strata = 2 * std::sqrt(double(samples)) - 1;
    EXPECT_GT(crossed, 100);
    EXPECT_LT(std::sqrt(square / crossed), std::sqrt(strata / 4) / samples) << samples;
    EXPECT_LT(largest, strata / samples) << samples;
  }
}

// A glass ball over a floor in thin air, without ambient light: all luminance is of one of three layers.
Scene ballInAir() {
  Scene scene;
  scene.camera.position = {0, 3, 5};
  scene.environment.background = vec3(0);
  scene.materials.resize(2);
  scene.materials[1].type = MaterialType::dielectric;
  scene.meshes = {makePlane({8, 8}), makeSphere(0.5f, {.vertices = 700})};
  scene.objects.resize(2);
  scene.objects[1] = {"ball", 1, 1, {vec3(0, 1, 0)}, std::nullopt};
  scene.lights.resize(1);
  scene.lights[0].position = {0.5f, 4, 0.5f};
  scene.lights[0].intensity = vec3(40);
  scene.medium = Medium{};
  scene.medium->extinction = 0.05f;
  scene.medium->albedo = 0.9f;
  return scene;
}

TEST_F(Samples, LayersAreTheSameMeanAndSumUpToIt) {
  const Scene scene = ballInAir();
  const Image layers = Sampled(scene, defaultTechnique(), 7).layers(scene);
  const auto total = *layers.find("G"), direct = *layers.find("direct.G"),
             caustics = *layers.find("caustics.G"), shafts = *layers.find("shafts.G");
  double sum = 0;
  for (std::size_t i = 0; i < total.size(); ++i) {
    EXPECT_NEAR(total[i], direct[i] + caustics[i] + shafts[i], 1e-5 + 1e-5 * double(total[i]));
    sum += double(caustics[i]);
  }
  EXPECT_GT(sum, 0);
}

// Samples that are gathered one after another make what one frame of as many does, and only what follows the
// view is made again for each.
TEST_F(Samples, GatheredAreTheSameAsDrawnAtOnce) {
  const Scene scene = ballInAir();
  Sampled atOnce(scene, defaultTechnique(), 5), gathering(scene, defaultTechnique(), 1);
  const std::vector<PassTime> passes = atOnce.renderer.render(scene);
  const auto samplesOf = [&](const std::string& name) {
    const auto found = std::ranges::find(passes, name, &PassTime::name);
    return found == passes.end() ? 0 : found->samples;
  };
  for (const char* once : {"beams", "shadow maps", "landed light"}) EXPECT_EQ(samplesOf(once), 1u) << once;
  for (const char* each : {"receivers", "casters", "direct light", "caustics", "shafts", "composite"})
    EXPECT_EQ(samplesOf(each), 5u) << each;
  gathering.renderer.render(scene);
  EXPECT_EQ(gathering.renderer.gathered(), 0u);
  for (uint32_t i = 1; i <= 5; ++i) {
    for (const PassTime& pass : gathering.renderer.gather(5)) EXPECT_NE(pass.name, "beams");
    EXPECT_EQ(gathering.renderer.gathered(), i);
  }
  EXPECT_EQ(gathering.renderer.picture().bytes, atOnce.renderer.picture().bytes);
  const Image a = gathering.renderer.layers(), b = atOnce.renderer.layers();
  for (const ImageChannel& channel : a.channels)
    EXPECT_EQ(channel.values, *b.find(channel.name)) << channel.name;
}

// What was gathered is forgotten by the next frame, which is that of one sample again.
TEST_F(Samples, NothingIsKeptAcrossFrames) {
  Scene scene = ballInAir();
  Sampled gathering(scene, defaultTechnique(), 1), fresh(scene, defaultTechnique(), 1);
  gathering.renderer.render(scene);
  gathering.renderer.gather(4);
  scene.lights[0].position.x += 0.2f;
  gathering.renderer.render(scene);
  EXPECT_EQ(gathering.renderer.gathered(), 0u);
  fresh.renderer.render(scene);
  EXPECT_EQ(gathering.renderer.picture().bytes, fresh.renderer.picture().bytes);
  const Image a = gathering.renderer.layers(), b = fresh.renderer.layers();
  for (const ImageChannel& channel : a.channels)
    EXPECT_EQ(channel.values, *b.find(channel.name)) << channel.name;
}

TEST_F(Samples, OfAnEvenFieldAreOneSample) {
  Scene scene = ballInAir();
  scene.medium.reset();
  scene.objects.clear();
  scene.environment.background = vec3(0.37f, 0.11f, 2.3f);
  const Image one = Sampled(scene, "none", 1).layers(scene), many = Sampled(scene, "none", 23).layers(scene);
  for (const char* channel : {"R", "G", "B"})
    for (std::size_t i = 0; i < one.pixelCount(); ++i) {
      const float even = (*one.find(channel))[i];
      EXPECT_NEAR((*many.find(channel))[i], even, 1e-6 * double(even));
    }
}

// Rays and what is drawn agree, at any place in the pixels.
TEST(ShiftedView, SeesAlongItsRays) {
  Camera camera;
  camera.position = {1, 2, 3};
  camera.target = {0, 0.5f, -1};
  const View middle = viewOf(camera, kSize);
  for (const vec2 place : {vec2(0), vec2(0.4f, -1.3f), vec2(-0.7f, 0.2f)}) {
    const View view = viewAt(middle, place, kSize);
    const PictureRays rays = raysOf(view), middleRays = raysOf(middle);
    for (const vec2 pixel : {vec2(10.5f, 20.5f), vec2(63.5f, 0.5f)}) {
      const auto clipOf = [](vec2 at) { return 2.0f * at / vec2(kSize) - 1.0f; };
      const vec2 clip = clipOf(pixel), sought = clipOf(pixel + place);
      const vec3 direction = rays.middle + clip.x * rays.right + clip.y * rays.down;
      const vec3 expected = middleRays.middle + sought.x * middleRays.right + sought.y * middleRays.down;
      EXPECT_LT(distance(direction, expected), 1e-5f);
      const vec4 seen = view.worldToClip * vec4(view.eye + 3.0f * direction, 1);
      EXPECT_LT(distance(vec2(seen) / seen.w, clip), 1e-5f);
    }
  }
}

}  // namespace
}  // namespace nephroid
