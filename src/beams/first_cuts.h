// What is done to a caster's triangles before light through them is judged by their corners.
#pragma once

#include <algorithm>
#include <cmath>

#include "geometry/mesh.h"

namespace nephroid {

// How many times a triangle of a mesh of that extent (m) is cut in four whatever it does: one that is longer
// than a small part of the mesh may hide what its corners say nothing of.
inline uint32_t firstCutsFor(const Mesh& mesh, const uvec3& t, float extent) {
  constexpr float kCoarseFraction = 1.0f / 24;
  constexpr float kMostCuts = 7;
  const vec3 &a = mesh.positions[t.x], &b = mesh.positions[t.y], &c = mesh.positions[t.z];
  const float longest = std::max({length(b - a), length(c - b), length(a - c)});
  const float cuts = std::ceil(std::log2(longest / (kCoarseFraction * extent)));
  return uint32_t(glm::clamp(cuts, 0.0f, kMostCuts));
}

}  // namespace nephroid
