#include "beams/incident_flux.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace nephroid {
namespace {

// Solid angle of a triangle seen from the origin (Van Oosterom and Strackee 1983), positive when it is seen
// counter-clockwise.
float solidAngle(vec3 a, vec3 b, vec3 c) {
  const glm::dvec3 p(a), q(b), r(c);
  const double la = glm::length(p), lb = glm::length(q), lc = glm::length(r);
  const double denominator = la * lb * lc + glm::dot(p, q) * lc + glm::dot(p, r) * lb + glm::dot(q, r) * la;
  return float(-2 * std::atan2(glm::dot(p, glm::cross(q, r)), denominator));
}

// Into how many parts a side of a triangle is cut so that no part spans more than a texel of a gobo or the
// bend of a cone. Corners from the light.
uint32_t partsOfSide(const ShapedLight& light, const Emitter& emitter, const std::array<vec3, 3>& corners) {
  constexpr float kWidestPart = 0.05f;  // rad
  constexpr uint32_t kPartsInFalloff = 4, kMostParts = 16;
  float parts = 1, falloff[3];
  vec2 texels[3];
  for (int i = 0; i < 3; ++i) {
    const vec3 direction = normalize(corners[i]);
    falloff[i] = coneFalloff(dot(direction, emitter.direction), emitter.coneScale, emitter.coneOffset);
    const vec3 local = alongFrame(light.frame, direction);
    texels[i] = vec2(local) * (length(light.goboTurn) / std::max(local.z, 1e-3f));
    parts = std::max(parts, length(direction - normalize(corners[(i + 1) % 3])) / kWidestPart);
  }
  for (int i = 0; i < 3; ++i) {
    if (light.gobo) parts = std::max(parts, length(texels[i] - texels[(i + 1) % 3]));
    if (falloff[i] != falloff[0]) parts = std::max(parts, float(kPartsInFalloff));
  }
  return std::min(uint32_t(std::ceil(std::min(parts, float(kMostParts)))), kMostParts);
}

// Over the solid angle of a triangle. Corners from the light.
vec3 meanIntensity(const ShapedLight& light, const Emitter& emitter, const std::array<vec3, 3>& corners) {
  const uint32_t parts = partsOfSide(light, emitter, corners);
  const vec3 across = (corners[1] - corners[0]) / float(parts),
             along = (corners[2] - corners[0]) / float(parts);
  vec3 sum(0);
  float weights = 0;
  const auto add = [&](float x, float y) {
    const vec3 middle = corners[0] + x * across + y * along;
    const vec3 direction = normalize(middle);
    // All parts have one area and lie in one plane.
    const float weight = 1 / std::pow(dot(middle, middle), 1.5f);
    sum += weight * (light.isShaped() ? lightIntensity(light, direction) : emitterPower(emitter, direction));
    weights += weight;
  };
  constexpr float kThird = 1.0f / 3;
  for (uint32_t y = 0; y < parts; ++y)
    for (uint32_t x = 0; x + y < parts; ++x) {
      add(float(x) + kThird, float(y) + kThird);
      if (x + y + 1 < parts) add(float(x) + 2 * kThird, float(y) + 2 * kThird);
    }
  return sum / weights;
}

}  // namespace

vec3 fluxOnto(const ShapedLight& light, const Emitter& emitter, vec3 a, vec3 b, vec3 c) {
  if (emitter.type == kEmitterDirectional)
    return emitter.power * (-0.5f * dot(emitter.direction, cross(b - a, c - a)));
  const std::array<vec3, 3> corners{a - emitter.position, b - emitter.position, c - emitter.position};
  const vec3 power = emitter.type == kEmitterPoint ? emitter.power : meanIntensity(light, emitter, corners);
  return power * solidAngle(corners[0], corners[1], corners[2]);
}

}  // namespace nephroid
