#include "geometry/tangent_plane.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace nephroid {
namespace {

// Whichever of its points a texel shows, and however long the normal is.
TEST(TangentPlane, OfAFlatSurfaceIsMetInOneStep) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> within(-1, 1);
  const auto some = [&] { return vec3(within(random), within(random), within(random)); };
  for (int i = 0; i < 100; ++i) {
    const vec3 normal = normalize(some()), shown = some(), start = shown + some() + 2.0f * normal;
    const vec3 along = normalize(cross(normal, some()));
    const vec3 direction = normalize(along - normal);
    const float height = dot(start - shown, normal);
    for (const vec3 texel : {shown, shown + 0.5f * along}) {
      const PlaneMeeting meeting = meetTangentPlane(start, direction, tangentPlane(texel, 3.0f * normal));
      EXPECT_NEAR(meeting.distance, std::sqrt(2.0f) * height, 1e-5f * height);
      EXPECT_NEAR(meeting.approach, 3 * std::sqrt(0.5f), 1e-5f);
    }
  }
}

TEST(TangentPlane, SaysFromWhichSideAndHowFarBehindItIsMet) {
  const TangentPlane floor = tangentPlane({5, 1, 7}, {0, 1, 0});
  const PlaneMeeting above = meetTangentPlane({0, 3, 0}, {0, -1, 0}, floor);
  EXPECT_EQ(above.distance, 2);
  EXPECT_EQ(above.approach, 1);
  const PlaneMeeting below = meetTangentPlane({0, 0, 0}, {0, 1, 0}, floor);
  EXPECT_EQ(below.distance, 1);
  EXPECT_EQ(below.approach, -1);
  EXPECT_EQ(meetTangentPlane({0, 3, 0}, {0, 1, 0}, floor).distance, -2);
  EXPECT_FALSE(std::isfinite(meetTangentPlane({0, 3, 0}, {1, 0, 0}, floor).distance));
}

// A bowl that opens upward and that a camera above it sees. Each step leaves about the square of the error
// before it.
TEST(TangentPlane, StepByStepLeadsToACurvedSurface) {
  const auto heightAt = [](vec3 p) { return 0.2f * (p.x * p.x + p.z * p.z); };
  const vec3 start(0.3f, 2, -0.4f), direction = normalize(vec3(0.5f, -1, 0.3f));
  float distance = 1;  // m
  for (int i = 0; i < 4; ++i) {
    const vec3 at = start + distance * direction;
    const TangentPlane plane =
        tangentPlane({at.x, heightAt(at), at.z}, normalize(vec3(-0.4f * at.x, 1, -0.4f * at.z)));
    distance += meetTangentPlane(at, direction, plane).distance;
  }
  const vec3 met = start + distance * direction;
  EXPECT_NEAR(met.y, heightAt(met), 1e-6);
}

}  // namespace
}  // namespace nephroid
