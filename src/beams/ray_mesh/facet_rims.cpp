#include "beams/ray_mesh/facet_rims.h"

#include <algorithm>

#include "beams/ray_mesh/edge_table.h"

namespace nephroid {
namespace {

constexpr float kOffRim = 1e-3f;  // part of the triangle

}  // namespace

// Vertices have one normal each, so that those of facets are apart where facets meet.
FacetRims::FacetRims(const Mesh& mesh) {
  if (!mesh.hasEdges()) return;
  EdgeTable uses;
  for (const uvec3& t : mesh.triangles)
    for (int i = 0; i < 3; ++i) {
      uint32_t& count = uses.at(t[(i + 1) % 3], t[(i + 2) % 3]);
      count = count == EdgeTable::kEmpty ? 1 : count + 1;
    }
  isRim_.assign(3 * mesh.triangles.size(), 0);
  isRimCorner_.assign(mesh.positions.size(), 0);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (int i = 0; i < 3; ++i) {
      const uint32_t a = mesh.triangles[t][(i + 1) % 3], b = mesh.triangles[t][(i + 2) % 3];
      if (uses.find(a, b) != 1) continue;
      isRim_[3 * t + std::size_t(i)] = 1;
      isRimCorner_[a] = isRimCorner_[b] = 1;
    }
}

vec2 FacetRims::movedOff(const Mesh& mesh, uint32_t triangle, vec2 weights) const {
  if (isRim_.empty()) return weights;
  vec3 all(1 - weights.x - weights.y, weights);
  for (int i = 0; i < 3; ++i) {
    const bool isAtCorner = all[i] > 1 - kOffRim && isRimCorner_[mesh.triangles[triangle][i]];
    const bool isOnRim = all[i] < kOffRim && isRim_[3 * std::size_t(triangle) + std::size_t(i)];
    if (isAtCorner) return mix(weights, vec2(1.0f / 3), kOffRim);
    if (isOnRim) all[i] = kOffRim;
  }
  all /= all.x + all.y + all.z;
  return {all.y, all.z};
}

}  // namespace nephroid
