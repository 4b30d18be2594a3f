// Maps directions to a square and back (the octahedral map, Cigolle et al. 2014). Unlike two angles, it has
// no dense points at poles. Written once for C++ and GLSL.
#ifndef NEPHROID_CORE_OCTAHEDRAL_H
#define NEPHROID_CORE_OCTAHEDRAL_H

#include "core/shared_language.h"

SHARED_BEGIN

SHARED_FUNCTION float octahedralSign(float x) {
  return x >= 0.0f ? 1.0f : -1.0f;
}

// The place of a unit vector on the square [0, 1]^2, and the way back.
SHARED_FUNCTION vec2 octahedralFromDirection(vec3 d) {
  float norm = abs(d.x) + abs(d.y) + abs(d.z);
  vec2 p = vec2(d.x, d.y) / norm;
  if (d.z < 0.0f) {
    p = vec2((1.0f - abs(p.y)) * octahedralSign(p.x), (1.0f - abs(p.x)) * octahedralSign(p.y));
  }
  return p * 0.5f + 0.5f;
}

SHARED_FUNCTION vec3 directionFromOctahedral(vec2 square) {
  vec2 p = square * 2.0f - 1.0f;
  float z = 1.0f - abs(p.x) - abs(p.y);
  float fold = max(-z, 0.0f);
  return normalize(vec3(p.x - fold * octahedralSign(p.x), p.y - fold * octahedralSign(p.y), z));
}

SHARED_END

#endif
