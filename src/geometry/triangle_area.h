// Areas of a mesh's triangles.
#pragma once

#include <algorithm>

#include "geometry/mesh.h"

namespace nephroid {

// m2, along the triangle's normal.
inline glm::dvec3 areaVector(const Mesh& mesh, uvec3 t) {
  const glm::dvec3 a = mesh.positions[t.x], b = mesh.positions[t.y], c = mesh.positions[t.z];
  return 0.5 * glm::cross(b - a, c - a);
}

// Flatter than what single precision can tell from a line.
inline bool hasNoArea(const Mesh& mesh, uvec3 t) {
  const glm::dvec3 a = mesh.positions[t.x], b = mesh.positions[t.y], c = mesh.positions[t.z];
  const double longest = std::max({glm::dot(b - a, b - a), glm::dot(c - b, c - b), glm::dot(a - c, a - c)});
  return !(glm::length(areaVector(mesh, t)) > 1e-9 * longest);
}

}  // namespace nephroid
