#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "optics/refraction.h"

namespace nephroid {
namespace {

constexpr float kDegrees = std::numbers::pi_v<float> / 180;

// Outside numbers: any optics textbook's for glass of index 1.5.
TEST(Fresnel, NormalIncidenceOnGlassReflectsFourPercent) {
  EXPECT_NEAR(fresnelReflectance(1, 1 / 1.5f), 0.04f, 1e-6f);
  EXPECT_NEAR(fresnelReflectance(1, 1.5f), 0.04f, 1e-6f);
}

TEST(Fresnel, HalfOfTheLightIsGoneOfOnePolarizationAtBrewstersAngle) {
  const float brewster = 56.30993f * kDegrees;
  // Only the perpendicular part is reflected there: ((n^2 - 1) / (n^2 + 1))^2 of it.
  const float perpendicular = std::pow((2.25f - 1) / (2.25f + 1), 2.0f);
  EXPECT_NEAR(fresnelReflectance(std::cos(brewster), 1 / 1.5f), 0.5f * perpendicular, 1e-6f);
}

TEST(Fresnel, AllIsReflectedPastTheCriticalAngle) {
  EXPECT_LT(fresnelReflectance(std::cos(41.80f * kDegrees), 1.5f), 1);
  EXPECT_EQ(fresnelReflectance(std::cos(41.82f * kDegrees), 1.5f), 1);
}

TEST(Fresnel, IsTheSameInBothDirectionsAlongARay) {
  for (float angle = 0; angle < 90; angle += 1) {
    const float cosOutside = std::cos(angle * kDegrees);
    const float sinInside = std::sin(angle * kDegrees) / 1.5f;
    EXPECT_NEAR(fresnelReflectance(cosOutside, 1 / 1.5f),
                fresnelReflectance(std::sqrt(1 - sinInside * sinInside), 1.5f), 2e-5f);
  }
}

TEST(Refraction, FollowsSnellsLaw) {
  const vec3 incident = glm::normalize(vec3(1, -1, 0));
  vec3 transmitted;
  ASSERT_TRUE(refractDirection(incident, vec3(0, 1, 0), 1 / 1.5f, transmitted));
  EXPECT_NEAR(transmitted.x, std::sin(45 * kDegrees) / 1.5f, 1e-6f);
  EXPECT_NEAR(glm::length(transmitted), 1, 1e-6f);
  EXPECT_FALSE(refractDirection(incident, vec3(0, 1, 0), 1.5f, transmitted));
}

TEST(Absorption, IsTheColorAfterTheDistance) {
  const vec3 color(0.8f, 1.0f, 0.5f);
  EXPECT_EQ(volumeTransmittance(color, 2, 0.5f), color);
  EXPECT_NEAR(volumeTransmittance(color, 2, 1).z, 0.25f, 1e-6f);
  EXPECT_EQ(volumeTransmittance(color, 0, 5), vec3(1));
}

}  // namespace
}  // namespace nephroid
