// Straight ways through boxes along the axes.
#ifndef NEPHROID_GEOMETRY_BOX_H
#define NEPHROID_GEOMETRY_BOX_H

#include "core/shared_language.h"

SHARED_BEGIN

// From where to where (m) a way of `length` from `from` along unit `direction` runs between the corners `low`
// and `high`. Misses where y <= x.
SHARED_FUNCTION vec2 wayThroughBox(vec3 low, vec3 high, vec3 from, vec3 direction, float length) {
  const float kAlongAFace = 1e-12f;
  vec2 part = vec2(0.0f, length);
  for (int axis = 0; axis < 3; ++axis) {
    const float inverse = 1.0f / (abs(direction[axis]) < kAlongAFace ? kAlongAFace : direction[axis]);
    const float a = (low[axis] - from[axis]) * inverse, b = (high[axis] - from[axis]) * inverse;
    part = vec2(max(part.x, min(a, b)), min(part.y, max(a, b)));
  }
  return part;
}

SHARED_END

#endif
