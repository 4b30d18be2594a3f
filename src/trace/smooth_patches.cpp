#include "trace/smooth_patches.h"

#include <algorithm>
#include <array>
#include <numeric>

namespace nephroid {
namespace {

constexpr float kSameNormalCosine = 0.9998f;

uint32_t rootOf(std::vector<uint32_t>& parent, uint32_t i) {
  while (parent[i] != i) i = parent[i] = parent[parent[i]];
  return i;
}

// Joins vertices that stand at the same place with the same normal (seams of texture coordinates).
void joinSeams(const Mesh& mesh, std::vector<uint32_t>& parent) {
  std::vector<uint32_t> order(mesh.positions.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto key = [&](uint32_t i) {
    const vec3& p = mesh.positions[i];
    return std::array{p.x, p.y, p.z};
  };
  std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) { return key(a) < key(b); });
  for (std::size_t first = 0; first < order.size();) {
    std::size_t last = first + 1;
    while (last < order.size() && key(order[last]) == key(order[first])) ++last;
    for (std::size_t i = first; i < last; ++i)
      for (std::size_t j = i + 1; j < last; ++j)
        if (dot(mesh.normals[order[i]], mesh.normals[order[j]]) > kSameNormalCosine)
          parent[rootOf(parent, order[j])] = rootOf(parent, order[i]);
    first = last;
  }
}

}  // namespace

std::vector<uint32_t> smoothPatches(const Mesh& mesh) {
  std::vector<uint32_t> parent(mesh.positions.size());
  std::iota(parent.begin(), parent.end(), 0u);
  joinSeams(mesh, parent);
  for (const uvec3& triangle : mesh.triangles) {
    parent[rootOf(parent, triangle.y)] = rootOf(parent, triangle.x);
    parent[rootOf(parent, triangle.z)] = rootOf(parent, triangle.x);
  }
  std::vector<uint32_t> patchOfRoot(parent.size(), kNone);
  std::vector<uint32_t> patches(mesh.triangles.size());
  uint32_t count = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    uint32_t& patch = patchOfRoot[rootOf(parent, mesh.triangles[t].x)];
    if (patch == kNone) patch = count++;
    patches[t] = patch;
  }
  return patches;
}

}  // namespace nephroid
