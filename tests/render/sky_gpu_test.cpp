// Skies in pictures: in open pixels against the sky itself, in glass and in mirrors against the reference.
#include "core/color.h"
#include "geometry/shapes.h"
#include "lights/clear_sky.h"
#include "lights/seen_skies.h"
#include "reference/image.h"
#include "render/view.h"
#include "support/drawing.h"
#include "support/gpu_fixture.h"
#include "support/reference_scenes.h"

namespace nephroid {
namespace {

constexpr uvec2 kSize(48, 36);

// A ball under a clear sky, whose sun is in the picture.
Scene ballInTheOpen(const Material& material) {
  Scene scene;
  scene.camera.position = {0, 0, 4};
  scene.camera.target = {0, 0.6f, 0};
  scene.camera.verticalFov = 60;
  add(scene, makeSphere(0.8f, {.vertices = 6400}), material, {0.3f, 0.2f, 0});
  Light sky;
  sky.name = "sky";
  sky.samples = 4;
  sky.sun = 0;
  scene.lights.push_back(makeClearSky({.azimuth = -18, .elevation = 24}, scene, sky));
  scene.lights.push_back(sky);
  return scene;
}

vec3 colorAt(const Image& image, std::size_t i, const std::string& prefix = "") {
  return {image.find(prefix + "R")->at(i), image.find(prefix + "G")->at(i), image.find(prefix + "B")->at(i)};
}

vec3 directionOf(const View& view, std::size_t pixel) {
  const PictureRays rays = raysOf(view);
  const vec2 place = 2.0f * (vec2(pixel % kSize.x, pixel / kSize.x) + 0.5f) / vec2(kSize) - 1.0f;
  return normalize(rays.middle + place.x * rays.right + place.y * rays.down);
}

class SkyGpuTest : public GpuTest {
 protected:
  static Image layersOf(const Scene& scene, const std::string& technique, uint32_t samples,
                        SightMethod method = SightMethod::rays) {
    Drawing drawing(device(), scene, settingsOf(technique),
                    {.size = kSize, .shadowMapSize = 64, .samples = samples, .sight = {.method = method}});
    return drawing.layers(scene);
  }
};

TEST_F(SkyGpuTest, OpenPixelsShowTheSkyByEveryTechnique) {
  const Scene scene = ballInTheOpen(glass());
  SeenSkies skies(scene);
  skies.place(scene);
  const View view = viewOf(scene.camera, kSize);
  for (const TechniqueInfo* info : techniques()) {
    const Image image = layersOf(scene, info->name, 1);
    std::size_t open = 0;
    float brightest = 0;
    for (std::size_t i = 0; i < image.pixelCount(); ++i) {
      if (image.find("depth.Z")->at(i) > 0) continue;
      ++open;
      const vec3 toward = directionOf(view, i), seen = colorAt(image, i);
      const vec3 expected = skies.luminance(toward, view.pixelAngle * dot(toward, view.forward));
      EXPECT_LT(distance(seen, expected), 2e-3f * luminanceOf(expected)) << info->name << " pixel " << i;
      EXPECT_EQ(colorAt(image, i, "direct."), vec3(0));
      EXPECT_EQ(colorAt(image, i, "caustics."), vec3(0));
      brightest = std::max(brightest, luminanceOf(seen));
    }
    EXPECT_GT(open, image.pixelCount() / 2) << info->name;
    EXPECT_GT(brightest, 1e7f) << "the sun";
  }
}

// Means over blocks of pixels.
void expectLikeReference(const Scene& scene, const Image& image, double tolerance) {
  const RayScene rays(scene);
  ReferenceSettings settings;
  settings.size = kSize;
  settings.photons = 1u << 15;
  ReferenceImage reference(scene, rays, settings);
  for (int i = 0; i < 12; ++i) reference.pass();
  const Image truth = reference.image();
  constexpr uint32_t kBlock = 4;
  double off = 0, all = 0;
  for (uint32_t y = 0; y < kSize.y; y += kBlock)
    for (uint32_t x = 0; x < kSize.x; x += kBlock) {
      double seen = 0, expected = 0;
      for (uint32_t j = 0; j < kBlock; ++j)
        for (uint32_t i = 0; i < kBlock; ++i) {
          const std::size_t pixel = std::size_t(y + j) * kSize.x + x + i;
          seen += double(luminanceOf(colorAt(image, pixel)));
          expected += double(luminanceOf(colorAt(truth, pixel)));
        }
      off += std::abs(seen - expected);
      all += expected;
      EXPECT_NEAR(seen / expected, 1, 8 * tolerance) << "block at " << x << ", " << y;
    }
  EXPECT_LT(off / all, tolerance);
}

// The sun's glints are so small that the reference finds few of them.
Scene ballWithoutSun(const Material& material) {
  Scene scene = ballInTheOpen(material);
  scene.lights[1].sun = kNone;
  return scene;
}

TEST_F(SkyGpuTest, GlassShowsTheSkyAsTheReferenceDoes) {
  const Scene scene = ballWithoutSun(glass());
  expectLikeReference(scene, layersOf(scene, "none", 16), 0.01);
  expectLikeReference(scene, layersOf(scene, "none", 16, SightMethod::slices), 0.03);
}

TEST_F(SkyGpuTest, MirrorsShowTheSkyAsTheReferenceDoes) {
  const Scene scene = ballWithoutSun(mirror(0.9f));
  expectLikeReference(scene, layersOf(scene, "none", 16), 0.01);
  expectLikeReference(scene, layersOf(scene, "none", 16, SightMethod::slices), 0.015);
}

// Light from afar that a mirroring ball sends to an eye at s m: E / ((1 + 2 s / (R cos)) (1 + 2 s cos / R)),
// by the focal lengths along and across the plane of incidence.
TEST_F(SkyGpuTest, TheSunInAMirrorHasItsLight) {
  constexpr float kRadius = 0.8f, kReflectance = 0.9f;
  const Scene scene = ballInTheOpen(mirror(kReflectance));
  const vec3 center = scene.objects[0].placement.translation, toSun = -scene.lights[0].direction;
  const vec3 eye = scene.camera.position;
  vec3 point = center;
  for (int i = 0; i < 50; ++i) point = center + kRadius * normalize(normalize(eye - point) + toSun);
  const float away = distance(eye, point), cosine = dot(toSun, (point - center) / kRadius);
  const float expected = kReflectance * luminanceOf(scene.lights[0].illuminance) /
                         ((1 + 2 * away / (kRadius * cosine)) * (1 + 2 * away * cosine / kRadius));

  const Image with = layersOf(scene, "none", 16);
  const Image without = layersOf(ballWithoutSun(mirror(kReflectance)), "none", 16);
  const View view = viewOf(scene.camera, kSize);
  double lux = 0;
  for (std::size_t i = 0; i < with.pixelCount(); ++i) {
    if (!(with.find("depth.Z")->at(i) > 0)) continue;
    const float slant = dot(directionOf(view, i), view.forward);
    lux += double(luminanceOf(colorAt(with, i) - colorAt(without, i)) * view.pixelAngle * view.pixelAngle *
                  slant * slant * slant);
  }
  EXPECT_NEAR(lux / double(expected), 1, 0.1);
}

TEST_F(SkyGpuTest, WhatIsSeenChangesWithTheLights) {
  Scene scene = ballInTheOpen(glass());
  Drawing drawing(device(), scene, settingsOf("none"),
                  {.size = kSize, .shadowMapSize = 64, .keepsLight = true});
  const auto changed = [&](const auto& change) {
    change(scene);
    const Image image = drawing.layers(scene), anew = layersOf(scene, "none", 1);
    for (const char* channel : {"R", "G", "B"}) EXPECT_EQ(*image.find(channel), *anew.find(channel));
    return colorAt(image, 0);
  };
  const vec3 first = changed([](Scene&) {});
  EXPECT_LT(distance(changed([](Scene& s) { s.lights[1].intensity *= 2; }), 2.0f * first), 1e-3f * first.y);
  EXPECT_NE(changed([](Scene& s) { s.lights[1].skyRotation = 40; }), 2.0f * first);
  EXPECT_EQ(changed([](Scene& s) {
              s.lights[1].isSeen = false;
              s.environment.background = vec3(1, 2, 3);
            }),
            vec3(1, 2, 3));
  const vec3 both = changed([](Scene& s) { s.lights[1].isSeen = true; });
  EXPECT_GT(both.x, 1000);
}

}  // namespace
}  // namespace nephroid
