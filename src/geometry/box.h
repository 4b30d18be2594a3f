// Boxes along the axes, and the part of a line within them.
#ifndef NEPHROID_GEOMETRY_BOX_H
#define NEPHROID_GEOMETRY_BOX_H

#include "core/shared_language.h"

SHARED_BEGIN

// The part of a line that is in the box with the corners `low` and `high`: its begin x and end y, in m from
// `from`. The line has a `length` (m) and goes from `from` along `direction` (unit). It misses the box where
// y <= x.
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

#ifdef __cplusplus

#include <algorithm>
#include <limits>

namespace nephroid {

// A box that grows with each point that is included. It is empty at first.
struct Box {
  vec3 low{std::numeric_limits<float>::infinity()};  // m
  vec3 high{-std::numeric_limits<float>::infinity()};

  void include(vec3 point) {
    low = glm::min(low, point);
    high = glm::max(high, point);
  }
  void include(const Box& other) {
    low = glm::min(low, other.low);
    high = glm::max(high, other.high);
  }
  bool isEmpty() const { return !(low.x <= high.x); }
  vec3 size() const { return high - low; }
  vec3 center() const { return 0.5f * (low + high); }
  float longestSide() const { return std::max({size().x, size().y, size().z}); }
  float diagonal() const { return glm::length(size()); }
  // `i` from 0 to 7: its bits choose the high side along x, y and z.
  vec3 corner(int i) const {
    return {(i & 1 ? high : low).x, (i & 2 ? high : low).y, (i & 4 ? high : low).z};
  }
  bool holds(vec3 point) const {
    return glm::all(glm::greaterThanEqual(point, low)) && glm::all(glm::lessThanEqual(point, high));
  }
  // Whether `other` is inside without touching a side.
  bool holdsInside(const Box& other) const {
    return glm::all(glm::greaterThan(other.low, low)) && glm::all(glm::lessThan(other.high, high));
  }
};

}  // namespace nephroid

#endif

#endif
