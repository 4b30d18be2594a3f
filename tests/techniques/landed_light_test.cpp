// Light where it landed: even where beams of different sizes meet, and sharp at any distance.
#include "techniques/adaptive_beams/landed_light.h"

#include <gtest/gtest.h>

namespace nephroid {
namespace {

constexpr float kLux = 3;
constexpr vec3 kUp(0, 1, 0);

// Light of kLux on the floor between three points (x, z).
LandedBeam evenBeam(vec2 a, vec2 b, vec2 c, float detail) {
  LandedBeam beam;
  const vec2 corners[3] = {a, b, c};
  for (int i = 0; i < 3; ++i) beam.corner[i] = vec3(corners[i].x, 0, corners[i].y);
  const vec2 ab = b - a, ac = c - a;
  const float doubled = std::abs(ab.x * ac.y - ab.y * ac.x);
  beam.flux = vec3(kLux * 0.5f * doubled);
  beam.width = doubled / std::max({length(ab), length(ac), length(c - b)});
  beam.texel = std::max(detail, beam.width / 2.5f);
  beam.leastNormal = beam.mostNormal = kUp;
  return beam;
}

// Two beams to each square of a grid.
void addSquares(RayMesh& mesh, vec2 low, vec2 high, uint32_t count, float detail) {
  const vec2 size = (high - low) / float(count);
  for (uint32_t y = 0; y < count; ++y)
    for (uint32_t x = 0; x < count; ++x) {
      const vec2 a = low + size * vec2(x, y), c = a + size, b(c.x, a.y), d(a.x, c.y);
      mesh.beams.push_back(evenBeam(a, b, c, detail));
      mesh.beams.push_back(evenBeam(a, c, d, detail));
    }
}

TEST(LandedLight, IsEvenWhereBeamsOfDifferentSizesMeet) {
  RayMesh mesh;
  addSquares(mesh, {0, 0}, {1, 1}, 4, 1e-3f);
  addSquares(mesh, {1, 0}, {2, 1}, 16, 1e-3f);
  addSquares(mesh, {0, 1}, {1, 2}, 6, 1e-3f);
  addSquares(mesh, {1, 1}, {2, 2}, 24, 1e-3f);
  LandedLight light;
  light.build(mesh);
  constexpr int kPoints = 150;
  for (int y = 0; y < kPoints; ++y)
    for (int x = 0; x < kPoints; ++x) {
      const vec2 at = 0.2f + 1.6f * (vec2(x, y) + 0.5f) / float(kPoints);
      EXPECT_NEAR(light.illuminanceAt({at.x, 0, at.y}, kUp).y, kLux, 0.02f * kLux) << at.x << ", " << at.y;
    }
  EXPECT_EQ(light.illuminanceAt({1, 0, 1}, -kUp), vec3(0));
  EXPECT_EQ(light.illuminanceAt({1, 0, 1}, vec3(1, 0, 0)), vec3(0));
}

TEST(LandedLight, IsSharpOnALargeFloor) {
  RayMesh mesh;
  addSquares(mesh, {-100, -100}, {100, 100}, 4, 1e-3f);
  addSquares(mesh, {3, 3}, {3.02f, 3.02f}, 8, 1e-3f);
  LandedLight light;
  light.build(mesh);
  EXPECT_NEAR(light.illuminanceAt({3.01f, 0, 3.01f}, kUp).y, 2 * kLux, 0.02f * kLux);
  EXPECT_NEAR(light.illuminanceAt({3.03f, 0, 3.01f}, kUp).y, kLux, 0.02f * kLux);
  EXPECT_NEAR(light.illuminanceAt({-50, 0, 20}, kUp).y, kLux, 0.02f * kLux);
  EXPECT_LT(light.bytes(), std::size_t{8} << 20);
}

TEST(LandedLight, PartsFloorsOneAboveTheOther) {
  RayMesh mesh;
  addSquares(mesh, {0, 0}, {1, 1}, 8, 1e-3f);
  const std::size_t ofFloor = mesh.beams.size();
  addSquares(mesh, {0.25f, 0.25f}, {0.75f, 0.75f}, 8, 1e-3f);
  for (std::size_t i = ofFloor; i < mesh.beams.size(); ++i) {
    mesh.beams[i].object = 1;
    for (vec3& corner : mesh.beams[i].corner) corner.y = 0.1f;
  }
  LandedLight light;
  light.build(mesh);
  EXPECT_NEAR(light.illuminanceAt({0.5f, 0, 0.5f}, kUp).y, kLux, 0.02f * kLux);
  EXPECT_NEAR(light.illuminanceAt({0.5f, 0.1f, 0.5f}, kUp).y, kLux, 0.02f * kLux);
}

}  // namespace
}  // namespace nephroid
