// How light turns where its lamp moves, against differences of the paths themselves.
#include "beams/ray_mesh/path_spread.h"

#include <gtest/gtest.h>

#include "optics/refraction.h"

namespace nephroid {
namespace {

constexpr float kStep = 1e-3f;  // of the lamp, along its axes

// Light from a lamp that meets a ball of radius 1 at `entry`, then a plane.
struct Way {
  vec3 direction, normal, after, landed;
};
const vec3 kEntry = normalize(vec3(0.2f, 1, -0.3f));
constexpr vec3 kLamp(0.5f, 4, 0.4f);
constexpr vec3 kPlaneNormal(0, 1, 0);
constexpr float kPlaneHeight = -2;

Way wayFrom(vec3 lamp, bool isReflected, vec3 entry) {
  Way way;
  way.direction = normalize(entry - lamp);
  way.normal = normalize(entry);
  if (isReflected)
    way.after = normalize(reflectDirection(way.direction, vec3(way.normal)));
  else
    refractDirection(way.direction, way.normal, 1 / 1.5f, way.after);
  const float plane = isReflected ? 6.0f : kPlaneHeight;
  way.landed = entry + (plane - entry.y) / way.after.y * way.after;
  return way;
}

class PathSpreadWays : public testing::TestWithParam<bool> {};

TEST_P(PathSpreadWays, IsTheDifferenceOfPaths) {
  const bool isReflected = GetParam();
  LampSpread lamp;
  lamp.axis[0] = {1, 0, 0};
  lamp.axis[1] = {0, 0.3f, 1};
  lamp.deviation = vec2(1);
  const Way way = wayFrom(kLamp, isReflected, kEntry);
  const PathSpread first = firstSpread(lamp, false, way.direction, distance(kLamp, kEntry));
  PathSpread after;
  if (isReflected)
    reflectSpread(first, way.direction, way.normal, after);
  else
    refractSpread(first, way.direction, way.normal, 1 / 1.5f, after);
  carrySpread(first, way.after, distance(kEntry, way.landed), kPlaneNormal, after);
  for (int i = 0; i < 2; ++i) {
    const Way moved = wayFrom(kLamp + kStep * lamp.axis[i], isReflected, kEntry);
    EXPECT_LT(length((moved.direction - way.direction) / kStep - first.direction[i]), 2e-3f);
    EXPECT_LT(length((moved.after - way.after) / kStep - after.direction[i]), 2e-3f);
    EXPECT_LT(length((moved.landed - way.landed) / kStep - after.position[i]), 1e-2f);
  }
}

// At the second boundary places and normals move as well.
TEST_P(PathSpreadWays, CountsTheTurnOfTheNormal) {
  const bool isReflected = GetParam();
  const Way way = wayFrom(kLamp, isReflected, kEntry);
  PathSpread before;
  for (int i = 0; i < 2; ++i) {
    const vec3 aside = i == 0 ? vec3(0.3f, 0, 0) : vec3(0, 0, 0.3f);
    before.position[i] = aside - dot(aside, way.normal) * way.normal;
    before.normal[i] = before.position[i];  // of a ball of radius 1
    before.direction[i] = (before.position[i] - dot(before.position[i], way.direction) * way.direction) /
                          distance(kLamp, kEntry);
  }
  PathSpread after;
  if (isReflected)
    reflectSpread(before, way.direction, way.normal, after);
  else
    refractSpread(before, way.direction, way.normal, 1 / 1.5f, after);
  for (int i = 0; i < 2; ++i) {
    const Way moved = wayFrom(kLamp, isReflected, normalize(kEntry + kStep * before.position[i]));
    EXPECT_LT(length((moved.after - way.after) / kStep - after.direction[i]), 5e-3f);
  }
}

INSTANTIATE_TEST_SUITE_P(Ways, PathSpreadWays, testing::Bool());

TEST(PathSpread, NormalsOfATriangleTurnWithItsPlaces) {
  const mat3 corners(vec3(0), vec3(1, 0, 0), vec3(0, 1, 0));
  const mat3 normals(normalize(vec3(-0.1f, -0.1f, 1)), normalize(vec3(0.2f, 0, 1)),
                     normalize(vec3(0, 0.3f, 1)));
  const vec3 at(0.3f, 0.3f, 0.4f);
  PathSpread spread;
  spread.position[0] = {1, 0, 0};
  spread.position[1] = {0.5f, -1, 0};
  turnNormals(corners, normals, at, spread);
  for (int i = 0; i < 2; ++i) {
    const vec3 moved = kStep * spread.position[i];
    const vec3 there = at + vec3(-moved.x - moved.y, moved.x, moved.y);
    EXPECT_LT(length((normalize(normals * there) - normalize(normals * at)) / kStep - spread.normal[i]),
              2e-3f);
  }
}

}  // namespace
}  // namespace nephroid
