#include "lights/lamp_irradiance.h"

#include <numbers>

#include "core/random.h"
#include "lights/lamp_light.h"

namespace nephroid {
namespace {

// lux on a surface, as the sum over many places of the lamp.
double summed(const Scene& scene, const Light& light, vec3 point, vec3 normal) {
  constexpr uint32_t kAlong = 200;
  const ShapedLight shaped = shapedLight(scene, light);
  const uint32_t rows = light.type == LightType::line ? 1 : kAlong;
  double sum = 0;
  for (uint32_t y = 0; y < rows; ++y)
    for (uint32_t x = 0; x < kAlong; ++x) {
      const vec2 at = (vec2(float(x), float(y)) + 0.5f) / vec2(float(kAlong), float(rows));
      const Illumination part = lampLight(light, shaped, point, at);
      sum += std::max(-dot(part.direction, normal), 0.0f) * part.illuminance.x;
    }
  return sum / double(rows * kAlong);
}

vec3 anyDirection(Random& random) {
  for (;;) {
    const vec3 v(2 * random.uniform() - 1, 2 * random.uniform() - 1, 2 * random.uniform() - 1);
    if (dot(v, v) < 1 && dot(v, v) > 0.01f) return normalize(v);
  }
}

// 200 places along a side miss the horizon by half of a step at most.
constexpr double kStep = 4e-3;

TEST(LampIrradiance, ABallCutByTheHorizonIsTheSumOfItsPlaces) {
  Random random(1);
  const Scene scene;
  int cut = 0;
  for (int i = 0; i < 100; ++i) {
    Light light;
    light.radius = 0.2f + random.uniform();
    const vec3 point = anyDirection(random) * (1.05f * light.radius + 2 * random.uniform());
    const vec3 toward = normalize(-point);
    const vec3 normal = i % 2 ? anyDirection(random)
                              : normalize(cross(toward, anyDirection(random)) + 0.3f * anyDirection(random));
    const float squared = dot(point, point), sineSquared = light.radius * light.radius / squared;
    const float cosine = dot(toward, normal);
    cut += cosine * cosine < sineSquared;
    EXPECT_NEAR(diskCosine(cosine, sineSquared), summed(scene, light, point, normal) * double(squared), kStep)
        << i;
  }
  EXPECT_GT(cut, 40);
}

TEST(LampIrradiance, ASunCutByTheHorizonIsTheSumOfItsPlaces) {
  const Scene scene;
  for (const float angle : {0.53f, 10.0f, 120.0f})
    for (const float steps : {-1.2f, -0.9f, -0.3f, 0.0f, 0.2f, 0.7f, 0.99f, 1.5f}) {
      Light light;
      light.type = LightType::directional;
      light.angle = angle;
      light.direction = vec3(0, -1, 0);
      const float half = glm::radians(0.5f * angle), sine = std::sin(half);
      const float height = std::clamp(steps * half, -1.5f, 1.5f);
      const vec3 normal(std::cos(height), std::sin(height), 0);
      EXPECT_NEAR(diskCosine(normal.y, sine * sine), summed(scene, light, vec3(0), normal),
                  kStep * double(sine))
          << angle << " at " << steps;
    }
}

TEST(LampIrradiance, APanelIsTheSumOfItsPlaces) {
  Random random(2);
  const Scene scene;
  int lit = 0;
  for (int i = 0; i < 200; ++i) {
    Light light;
    light.type = LightType::area;
    light.u = anyDirection(random) * (0.2f + random.uniform());
    light.v = cross(light.u, anyDirection(random)) + 0.3f * light.u;
    light.direction = normalize(cross(light.v, light.u));
    light.position = anyDirection(random);
    const vec3 point = light.position + 0.5f * (light.u + light.v) +
                       (i % 4 ? 1.0f : 100.0f) * (light.direction + 0.9f * anyDirection(random));
    const vec3 normal = anyDirection(random);
    const double sum = summed(scene, light, point, normal);
    const float area = length(cross(light.v, light.u));
    const float whole = length(light.u) + length(light.v);
    lit += sum > 0;
    EXPECT_NEAR(panelIntegral(light.position - point, light.u, light.v, normal) / area, sum,
                5 * kStep * sum + 1e-4 / double(whole))
        << i;
  }
  EXPECT_GT(lit, 60);
}

TEST(LampIrradiance, ASegmentIsTheSumOfItsPlaces) {
  Random random(3);
  const Scene scene;
  for (int i = 0; i < 200; ++i) {
    Light light;
    light.type = LightType::line;
    light.position = anyDirection(random);
    light.end = light.position + anyDirection(random) * (0.1f + random.uniform());
    const vec3 point =
        light.position + (i % 4 ? 1.0f : 500.0f) * (1.5f + random.uniform()) * anyDirection(random);
    const vec3 normal = anyDirection(random), side = light.end - light.position;
    const double sum = summed(scene, light, point, normal);
    EXPECT_NEAR(segmentIntegral(light.position - point, side, normal) / length(side), sum, kStep * sum + 2e-5)
        << i;
  }
}

// A disk overhead that fills the sky: pi times its luminance.
TEST(LampIrradiance, ASkyOfOneDiskIsAllOfIt) {
  EXPECT_NEAR(diskCosine(1, 1), 1, 1e-6);
  EXPECT_NEAR(diskCosine(0, 1), 0.5, 1e-3);  // half of it, to a wall
}

}  // namespace
}  // namespace nephroid
