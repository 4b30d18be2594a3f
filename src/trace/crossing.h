// What a boundary between two media does to light, for all that follows it.
#pragma once

#include <algorithm>
#include <span>

#include "optics/refraction.h"
#include "scene/scene.h"

namespace nephroid {

// Boundaries a ray may cross before it is given up as trapped.
inline constexpr uint32_t kMaximumCrossings = 48;

inline vec3 facingGeometric(vec3 direction, vec3 geometricNormal) {
  return dot(direction, geometricNormal) < 0 ? geometricNormal : -geometricNormal;
}

// The smooth normal on the side the light comes from; the geometric one where the smooth one faces away from
// the light.
inline vec3 facingNormal(vec3 direction, vec3 normal, vec3 geometricNormal) {
  const vec3 geometric = facingGeometric(direction, geometricNormal);
  const vec3 smooth = dot(direction, geometricNormal) < 0 ? normal : -normal;
  return dot(direction, smooth) < 0 ? smooth : geometric;
}

// Whether it is the geometric one.
inline bool facesAway(vec3 direction, vec3 normal, vec3 geometricNormal) {
  return dot(direction, normal) * dot(direction, geometricNormal) <= 0;
}

struct Reflection {
  vec3 direction{0};    // unit
  bool isFlat = false;  // it goes by the triangle's own normal
};

// Where light goes on from a boundary. `direction`: unit, of the light that arrives. Smooth normals stand for
// a surface that the triangles are near to; they count as far as the triangles allow: one that would send
// light through the surface, or back where it should go through, gives way to the triangle's own, so that no
// light is lost.
inline Reflection reflectedBy(vec3 direction, vec3 normal, vec3 geometricNormal) {
  const vec3 geometric = facingGeometric(direction, geometricNormal);
  const vec3 reflected = reflectDirection(direction, facingNormal(direction, normal, geometricNormal));
  if (dot(reflected, geometric) <= 0) return {reflectDirection(direction, geometric), true};
  return {reflected, facesAway(direction, normal, geometricNormal)};
}

struct Bend {
  vec3 reflected{0};      // unit
  vec3 transmitted{0};    // unit
  float reflectance = 1;  // 0..1; 1: nothing is transmitted
  bool isFlat = false;    // one of them goes by the triangle's own normal
};

// `eta`: the index of refraction on the side that light comes from, over that on the other.
inline Bend bendAt(vec3 direction, vec3 normal, vec3 geometricNormal, float eta) {
  const vec3 geometric = facingGeometric(direction, geometricNormal);
  const Reflection reflection = reflectedBy(direction, normal, geometricNormal);
  Bend bend;
  bend.reflected = reflection.direction;
  bend.isFlat = reflection.isFlat;
  vec3 facing = facingNormal(direction, normal, geometricNormal);
  bool isTransmitted = refractDirection(direction, facing, eta, bend.transmitted);
  if (isTransmitted && dot(bend.transmitted, geometric) >= 0) {
    bend.isFlat = true;
    facing = geometric;
    isTransmitted = refractDirection(direction, facing, eta, bend.transmitted);
  }
  if (isTransmitted) bend.reflectance = fresnelReflectance(std::min(1.0f, -dot(direction, facing)), eta);
  return bend;
}

// Of the object that fills a place; kNone is air.
inline float iorOf(std::span<const Material* const> materials, uint32_t object, uint32_t channel) {
  return object == kNone ? 1.0f : materials[object]->ior[int(channel)];
}

// The part (0..1) of light that a sheet too thin to bend it lets through, without its color: by both its
// faces, multiple reflections between them included. `normal` faces the light. The rest is reflected.
inline float thinWallTransmitted(const Material& material, uint32_t channel, vec3 direction, vec3 normal) {
  const float reflectance =
      fresnelReflectance(std::min(1.0f, -dot(direction, normal)), 1 / material.ior[int(channel)]);
  return (1 - reflectance) / (1 + reflectance);
}

inline vec3 thinWallTransmittance(const Material& material, uint32_t channel, vec3 direction, vec3 normal) {
  return material.color * thinWallTransmitted(material, channel, direction, normal);
}

}  // namespace nephroid
