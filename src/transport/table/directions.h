// The sampled directions of a light transport table (Iwasaki 2005, eq. 3), once for C++ and GLSL.
//
// Directions are local to a vertex: (x, y, z) along its tangent, binormal and normal. They point in the
// direction in which the light travels, so z < 0 where light meets the outside. Direction 0 is the pole
// (straight along the normal); then rings from the pole outward, `azimuths` directions each, beginning at the
// tangent.
#ifndef NEPHROID_TRANSPORT_TABLE_DIRECTIONS_H
#define NEPHROID_TRANSPORT_TABLE_DIRECTIONS_H

#include "core/shared_language.h"

SHARED_BEGIN

#ifdef __cplusplus
using glm::atan;
using glm::cos;
using glm::sin;
#endif

// Rings have equal steps in angle up to this angle. Light beyond it uses the rays of the last ring, with its
// own Fresnel transmittance on entry. At 90 degrees no light enters. Very near to 90 degrees, rays through
// the flat triangles of a ball are lost that would not be lost in the ball itself. In a test with 84.4, 86,
// 87, 88, 89 and 89.5 degrees, no rays were lost for this reason up to 87 degrees; the total flux differed by
// at most 0.2 %.
SHARED_CONSTANT float kOutermostRing = 1.5184364f;  // radians: 87 degrees from the normal
SHARED_CONSTANT float kTwoPi = 6.2831853f;

// The four sampled directions around a direction and their bilinear weights, which add up to 1: two of one
// ring, then two of the next. On the pole's side the first two are the pole twice.
struct DirectionCell {
  uvec4 direction;
  vec4 weight;
};

// The frame at a vertex: columns tangent, binormal, normal. Defined for every unit normal (Duff et al. 2017,
// Building an Orthonormal Basis, Revisited), so it is recomputed instead of stored.
SHARED_FUNCTION mat3 vertexFrame(vec3 normal) {
  float side = normal.z >= 0.0f ? 1.0f : -1.0f;
  float a = -1.0f / (side + normal.z);
  float b = normal.x * normal.y * a;
  vec3 tangent = vec3(1.0f + side * normal.x * normal.x * a, side * b, -side * normal.x);
  vec3 binormal = vec3(b, side + normal.y * normal.y * a, -normal.y);
  return mat3(tangent, binormal, normal);
}

SHARED_FUNCTION float ringAngle(uint ring, uint rings) {
  return kOutermostRing * float(ring) / float(rings);
}

// Equation 3, in the vertex's frame. `index` < 1 + rings * azimuths.
SHARED_FUNCTION vec3 sampledDirection(uint index, uint rings, uint azimuths) {
  if (index == 0u) return vec3(0.0f, 0.0f, -1.0f);
  float elevation = ringAngle((index - 1u) / azimuths + 1u, rings);
  float azimuth = kTwoPi * float((index - 1u) % azimuths) / float(azimuths);
  return -vec3(sin(elevation) * cos(azimuth), sin(elevation) * sin(azimuth), cos(elevation));
}

SHARED_FUNCTION uint directionOnRing(uint ring, uint azimuth, uint azimuths) {
  return ring == 0u ? 0u : 1u + (ring - 1u) * azimuths + azimuth % azimuths;
}

// `direction` is a unit vector in the vertex's frame.
SHARED_FUNCTION DirectionCell cellAround(vec3 direction, uint rings, uint azimuths) {
  float planar = sqrt(direction.x * direction.x + direction.y * direction.y);
  float turn = planar > 0.0f ? atan(-direction.y, -direction.x) / kTwoPi : 0.0f;
  float alongRing = (turn < 0.0f ? turn + 1.0f : turn) * float(azimuths);
  float outward = min(atan(planar, max(-direction.z, 0.0f)) / kOutermostRing, 1.0f) * float(rings);
  uint azimuth = min(uint(alongRing), azimuths - 1u);
  uint ring = min(uint(outward), rings - 1u);
  float a = alongRing - float(azimuth);
  float r = outward - float(ring);
  DirectionCell cell;
  cell.direction = uvec4(
      directionOnRing(ring, azimuth, azimuths), directionOnRing(ring, azimuth + 1u, azimuths),
      directionOnRing(ring + 1u, azimuth, azimuths), directionOnRing(ring + 1u, azimuth + 1u, azimuths));
  cell.weight = vec4((1.0f - r) * (1.0f - a), (1.0f - r) * a, r * (1.0f - a), r * a);
  return cell;
}

SHARED_END

#endif
