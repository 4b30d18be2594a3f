// Lamps with a size against closed forms: what they send to a point, and what of them an edge hides.
#include "lights/lamp_light.h"

#include <gtest/gtest.h>

#include "core/directions.h"
#include "lights/lamp_cells.h"

namespace nephroid {
namespace {

constexpr uint32_t kSide = 128;  // places of a lamp along a side

// Over all places of a lamp, the mean of use(place).
template <class Use>
double meanOver(const Use& use) {
  double sum = 0;
  for (uint32_t y = 0; y < kSide; ++y)
    for (uint32_t x = 0; x < kSide; ++x) sum += double(use((vec2(float(x), float(y)) + 0.5f) / float(kSide)));
  return sum / double(kSide * kSide);
}

Light ballOf(float radius) {
  Light light;
  light.position = {0.3f, 2, -0.4f};
  light.intensity = vec3(80);
  light.radius = radius;
  return light;
}

Light diskOf(float angle) {
  Light light;
  light.type = LightType::directional;
  light.direction = normalize(vec3(0.3f, -1, 0.2f));
  light.illuminance = vec3(1000);
  light.angle = angle;
  return light;
}

double luxOn(const Light& light, vec3 point, vec3 normal) {
  const ShapedLight shaped{lampOf(light)};
  return meanOver([&](vec2 at) {
    const Illumination from = lampLight(light, shaped, point, at);
    return std::max(-dot(from.direction, normal), 0.0f) * from.illuminance.x;
  });
}

// A ball that is evenly bright and wholly in view lights as a point does, from however near (Lambert 1760).
TEST(LampLight, BallLightsAsItsMiddleWould) {
  for (const float radius : {1e-3f, 0.1f, 0.5f, 1.5f})
    for (const vec3 point : {vec3(0.3f, 0, -0.4f), vec3(1, 0.1f, 0)}) {
      const Light light = ballOf(radius);
      const vec3 offset = light.position - point;
      const vec3 normal(0, 1, 0);
      if (dot(offset, normal) < radius) continue;  // it would be cut by the horizon
      const double expected = 80 * double(dot(offset, normal)) / std::pow(double(length(offset)), 3);
      EXPECT_NEAR(luxOn(light, point, normal), expected, 1e-3 * expected) << radius;
    }
}

TEST(LampLight, NothingComesFromWithinABall) {
  EXPECT_EQ(luxOn(ballOf(0.5f), ballOf(0).position + 0.2f, vec3(0, 1, 0)), 0);
}

TEST(LampLight, ShadowRaysEndOnTheBall) {
  const Light light = ballOf(0.5f);
  const ShapedLight shaped{lampOf(light)};
  const vec3 point(1, 0.1f, 0);
  meanOver([&](vec2 at) {
    const Illumination from = lampLight(light, shaped, point, at);
    EXPECT_NEAR(distance(point - from.distance * from.direction, light.position), 0.5f, 1e-3f);
    return 0.0f;
  });
}

TEST(LampLight, DiskOfTheSunLightsAsADirectionWould) {
  for (const float angle : {0.53f, 10.0f, 90.0f}) {
    const Light light = diskOf(angle);
    EXPECT_NEAR(luxOn(light, vec3(0), -light.direction), 1000, 1);
    const vec3 aside = normalize(cross(light.direction, vec3(0, 0, 1)));
    const vec3 tilted = normalize(-light.direction + 0.5f * aside);
    EXPECT_NEAR(luxOn(light, vec3(0), tilted), 1000 * double(dot(tilted, -light.direction)), 1) << angle;
  }
}

// Under a small disk, at a distance s from the edge of the shadow of a half plane at the height h, the part
// of the disk that is seen is that of a circle on one side of a chord.
TEST(LampLight, PenumbraOfAnEdgeIsThatOfAChord) {
  Light light = diskOf(2);
  light.direction = {0, -1, 0};
  const ShapedLight shaped{lampOf(light)};
  const double radius = std::tan(glm::radians(1.0));  // of the disk, at a height of 1
  for (const double s : {-1.1, -0.8, -0.3, 0.0, 0.5, 0.9, 1.2}) {
    const double seen = meanOver([&](vec2 at) {
      const vec3 toward = -lampLight(light, shaped, vec3(0), at).direction;
      return double(toward.x / toward.y) < s * radius ? 1.0f : 0.0f;
    });
    const double x = std::clamp(s, -1.0, 1.0);
    const double expected = 1 - (std::acos(x) - x * std::sqrt(1 - x * x)) / double(kPi);
    EXPECT_NEAR(seen, expected, 2.0 / kSide) << s;
  }
}

TEST(LampLight, LightSetsOutFromTheSideOfTheBallThatFacesItsWay) {
  const Light light = ballOf(0.5f);
  const vec3 direction = normalize(vec3(1, -2, 0.5f));
  glm::dvec3 sum(0);
  double squares = 0;
  meanOver([&](vec2 at) {
    const vec3 offset = lampOrigin(light, direction, at) - light.position;
    EXPECT_NEAR(length(offset), 0.5f, 1e-4f);
    EXPECT_GE(dot(offset, direction), 0);
    const vec3 aside = offset - dot(offset, direction) * direction;
    sum += glm::dvec3(aside);
    squares += double(dot(aside, aside));
    return 0.0f;
  });
  EXPECT_LT(glm::length(sum) / (kSide * kSide), 1e-4);
  EXPECT_NEAR(squares / (kSide * kSide), 0.5 * 0.25, 1e-3);  // evenly over its disk
}

TEST(LampCells, TogetherAreTheLamp) {
  Light panel;
  panel.type = LightType::area;
  panel.position = {-0.5f, 2, -0.5f};
  panel.u = {0, 0, 1};
  panel.v = {1, 0, 0};
  panel.direction = {0, -1, 0};
  panel.intensity = vec3(100);
  for (const Light& light : {panel, ballOf(0.6f), diskOf(20)}) {
    const std::vector<LampCell> cells = lampCells(light, 0, vec3(0), 0.3f, 0.01f);
    EXPECT_GT(cells.size(), 1u);
    double lux = 0;
    for (const LampCell& cell : cells) {
      const vec3 direction = emitterDirection(cell.emitter, vec3(0));
      const vec3 normal = light.type == LightType::directional ? -light.direction : vec3(0, 1, 0);
      lux += double(emitterIlluminance(cell.emitter, vec3(0)).x * -dot(direction, normal));
    }
    const vec3 normal = light.type == LightType::directional ? -light.direction : vec3(0, 1, 0);
    EXPECT_NEAR(lux, luxOn(light, vec3(0), normal), 0.01 * lux);
  }
}

TEST(LampCells, PlacesHaveTheMeanAndTheVarianceOfTheDisk) {
  const std::vector<LampCell> cells = lampCells(diskOf(0.53f), 0, vec3(0), 1, 0.01f);
  ASSERT_EQ(cells.size(), 1u);
  EXPECT_NEAR(cells[0].spread.deviation.x, 0.5f, 1e-3f);  // of a disk of radius 1
  glm::dvec2 sum(0), squares(0);
  for (const vec2 at : cells[0].spread.places) {
    sum += glm::dvec2(at);
    squares += glm::dvec2(at * at);
  }
  EXPECT_LT(glm::length(sum), 1e-4);
  EXPECT_NEAR(squares.x / kLampPlaces, 1, 1e-4);
  EXPECT_NEAR(squares.y / kLampPlaces, 1, 1e-4);
}

}  // namespace
}  // namespace nephroid
