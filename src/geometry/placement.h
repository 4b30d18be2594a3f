// The position, rotation and scale of an object.
#pragma once

#include "core/shared_language.h"

namespace nephroid {

// A rigid motion and a uniform scale. Other transformations are applied to the mesh when it is loaded. So
// what is computed for a mesh (a light transport table) is valid wherever the object stands.
struct Placement {
  vec3 translation{0};  // m
  quat rotation{1, 0, 0, 0};
  float scale = 1;
  vec3 point(vec3 p) const { return rotation * (scale * p) + translation; }
  vec3 direction(vec3 d) const { return rotation * d; }
  vec3 inversePoint(vec3 p) const { return glm::conjugate(rotation) * (p - translation) / scale; }
  vec3 inverseDirection(vec3 d) const { return glm::conjugate(rotation) * d; }
  bool operator==(const Placement&) const = default;
};

}  // namespace nephroid
