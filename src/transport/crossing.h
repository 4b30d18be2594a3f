// What a boundary between two media does to light, for all that follows it.
#pragma once

#include <algorithm>
#include <span>

#include "optics/refraction.h"
#include "scene/scene.h"

namespace nephroid {

// Boundaries a ray may cross before it is given up as trapped.
inline constexpr uint32_t kMaximumCrossings = 48;

// The smooth normal on the side the light comes from; the geometric one where the smooth one faces away from
// the light.
inline vec3 facingNormal(vec3 direction, vec3 normal, vec3 geometricNormal) {
  const float side = dot(direction, geometricNormal) < 0 ? 1.0f : -1.0f;
  return dot(direction, side * normal) < 0 ? side * normal : side * geometricNormal;
}

// Of the object that fills a place; kNone is air.
inline float iorOf(std::span<const Material* const> materials, uint32_t object, uint32_t channel) {
  return object == kNone ? 1.0f : materials[object]->ior[int(channel)];
}

// What a sheet too thin to bend light lets through: both its faces, multiple reflections between them
// included. `normal` faces the light.
inline vec3 thinWallTransmittance(const Material& material, uint32_t channel, vec3 direction, vec3 normal) {
  const float reflectance =
      fresnelReflectance(std::min(1.0f, -dot(direction, normal)), 1 / material.ior[int(channel)]);
  return material.color * ((1 - reflectance) / (1 + reflectance));
}

}  // namespace nephroid
