#include "lights/lamp_light.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/directions.h"

namespace nephroid {
namespace {

// Of the rays that reach `point` from a ball, one, by the solid angle.
Illumination ballLight(const Light& light, const ShapedLight& shaped, vec3 point, vec2 at) {
  const vec3 offset = light.position - point;
  const float away = length(offset), radius = light.radius;
  if (!(away > radius)) return {vec3(0, -1, 0), away, vec3(0)};  // from within nothing is seen
  const vec3 axis = offset / away;
  const float width = coneWidth(point, light.position, radius);
  const vec3 local = sampleCone(at, width);
  const float aside = away * std::sqrt(std::max(1 - local.z * local.z, 0.0f));
  const vec3 toward = normalize(frameAround(axis) * local);
  const float distance = away * local.z - std::sqrt(std::max(radius * radius - aside * aside, 0.0f));
  // Luminance is intensity over the area of the ball's disk.
  return {-toward, distance, lightIntensity(shaped, -toward) * (2 * width / (radius * radius))};
}

}  // namespace

bool hasSize(const Light& light) {
  switch (light.type) {
    case LightType::point:
    case LightType::spot:
      return light.radius > 0;
    case LightType::directional:
      return light.angle > 0;
    case LightType::line:
    case LightType::area:
      return true;
    case LightType::sky:
      break;
  }
  return false;
}

float extentOf(const Light& light) {
  if (light.type == LightType::line) return 0.5f * length(light.end - light.position);
  if (light.type == LightType::area)
    return 0.5f * std::max(length(light.u + light.v), length(light.u - light.v));
  return light.type == LightType::point || light.type == LightType::spot ? light.radius : 0;
}

float coneWidth(vec3 from, vec3 center, float radius) {
  const float sineSquared = radius * radius / std::max(dot(center - from, center - from), 1e-30f);
  if (!(sineSquared < 1)) return 2;
  return sineSquared / (1 + std::sqrt(1 - sineSquared));
}

LightFromAfar lampFromAfar(const Light& light, vec2 at) {
  if (light.angle == 0) return {light.direction, light.illuminance};
  const float sine = std::sin(glm::radians(0.5f * light.angle));
  const float cosine = std::cos(glm::radians(0.5f * light.angle));
  const float width = sine * sine / (1 + cosine);
  // A surface across the middle gets all of it at a slant, which is (1 + cosine) / 2 in the mean.
  return {normalize(frameAround(light.direction) * sampleCone(at, width)),
          light.illuminance * (2 / (1 + cosine))};
}

vec3 lampOrigin(const Light& light, vec3 direction, vec2 at) {
  if (light.type == LightType::line) return glm::mix(light.position, light.end, at.x);
  if (light.type == LightType::area) return light.position + at.x * light.u + at.y * light.v;
  if (light.radius == 0) return light.position;
  const vec2 disk = light.radius * sampleDisk(at);
  const float front = std::sqrt(std::max(light.radius * light.radius - dot(disk, disk), 0.0f));
  return light.position + frameAround(direction) * vec3(disk, front);
}

Illumination lampLight(const Light& light, const ShapedLight& shaped, vec3 point, vec2 at) {
  if (light.type == LightType::directional) {
    const LightFromAfar part = lampFromAfar(light, at);
    return {part.direction, std::numeric_limits<float>::infinity(), part.illuminance};
  }
  const bool isBall = (light.type == LightType::point || light.type == LightType::spot) && light.radius > 0;
  if (isBall) return ballLight(light, shaped, point, at);
  const vec3 offset = point - lampOrigin(light, vec3(0), at);
  const float distance = length(offset);
  const vec3 direction = offset / distance;
  return {direction, distance, lightIntensity(shaped, direction) / (distance * distance)};
}

}  // namespace nephroid
