#include "render/shadows/seen_lamps.h"

#include <oneapi/tbb/global_control.h>

#include "support/test_meshes.h"

namespace nephroid {
namespace {

constexpr uvec2 kSize(96, 64);

// A floor with two thin bars above it.
Scene barsOverFloor(float radius) {
  Scene scene;
  scene.materials.emplace_back();
  scene.meshes.push_back(plane(2));
  scene.meshes.push_back(box(vec3(0.004f, 0.004f, 0.5f)));
  scene.objects.push_back({"floor", 0, 0, {}, std::nullopt});
  scene.objects.push_back(
      {"bar", 1, 0, {vec3(0.1f, 0.4f, 0), glm::angleAxis(0.3f, vec3(0, 1, 0)), 1}, std::nullopt});
  scene.objects.push_back(
      {"bar", 1, 0, {vec3(-0.2f, 0.6f, 0), glm::angleAxis(-1.0f, vec3(0, 1, 0)), 1}, std::nullopt});
  Light light;
  light.position = {0.3f, 2, 0.2f};
  light.radius = radius;
  scene.lights.push_back(light);
  return scene;
}

// What is seen of the lamp from points 2 cm apart, moved in each of eight samples.
std::vector<std::vector<uint8_t>> seenInSamples(const Scene& scene, bool remembers) {
  const RayScene rays(scene);
  std::vector<MeshExtent> extents;
  for (const Mesh& mesh : scene.meshes) extents.push_back(extentOf(mesh));
  const std::vector<ShadowedLamp> lamps = shadowedLamps(scene, extents);
  SeenLamps seen;
  seen.resize(kSize);
  std::vector<std::vector<uint8_t>> samples;
  const std::vector<vec4> normals(kSize.x * kSize.y, vec4(0, 1, 0, 0));
  for (uint32_t sample = 0; sample < 8; ++sample) {
    std::vector<vec4> positions;
    for (uint32_t i = 0; i < kSize.x * kSize.y; ++i) {
      const vec2 at =
          vec2(float(i % kSize.x), float(i / kSize.x)) + vec2(float(sample % 3), float(sample % 4)) / 4.0f;
      positions.emplace_back(0.02f * (at.x - 48), 0, 0.02f * (at.y - 32), 1);
    }
    if (!remembers) seen.forget();
    seen.look(rays, lamps, {positions, normals, uvec2(0), kSize}, {sample, 8});
    samples.emplace_back(seen.parts(0).begin(), seen.parts(0).end());
  }
  return samples;
}

TEST(SeenLamps, FloorsShadowNothing) {
  Scene scene = barsOverFloor(0);
  std::vector<MeshExtent> extents;
  for (const Mesh& mesh : scene.meshes) extents.push_back(extentOf(mesh));
  EXPECT_EQ(shadowedLamps(scene, extents)[0].boxes.size(), 2u);
  scene.objects.resize(1);
  EXPECT_TRUE(shadowedLamps(scene, extents)[0].boxes.empty());
}

TEST(SeenLamps, IsTheSameForAnyNumberOfThreads) {
  for (const float radius : {0.0f, 0.2f}) {
    const Scene scene = barsOverFloor(radius);
    const auto many = seenInSamples(scene, true);
    const oneapi::tbb::global_control one(oneapi::tbb::global_control::max_allowed_parallelism, 1);
    EXPECT_EQ(many, seenInSamples(scene, true)) << radius;
  }
}

// Shadows of bars of 8 mm, where pixels are 20 mm wide.
TEST(SeenLamps, RemembersOnlyWhatIsSure) {
  const Scene scene = barsOverFloor(0);
  const auto remembered = seenInSamples(scene, true), anew = seenInSamples(scene, false);
  uint32_t dark = 0, wrong = 0;
  for (std::size_t sample = 0; sample < anew.size(); ++sample)
    for (std::size_t i = 0; i < anew[sample].size(); ++i) {
      dark += anew[sample][i] == 0;
      wrong += anew[sample][i] != remembered[sample][i];
    }
  EXPECT_GT(dark, 200u);
  EXPECT_LE(wrong, dark / 100);
}

}  // namespace
}  // namespace nephroid
