#include "geometry/mesh_edges.h"

#include <algorithm>

namespace nephroid {
namespace {

uvec3 placesOf(const uvec3& triangle, const std::vector<uint32_t>& joined) {
  return {joined[triangle.x], joined[triangle.y], joined[triangle.z]};
}

bool isDegenerate(const uvec3& v) {
  return v.x == v.y || v.y == v.z || v.z == v.x;
}

}  // namespace

// Sides are put into a row for each lower end, and each row is sorted by the higher one: several times as
// fast as sorting all at once.
MeshEdges::MeshEdges(const std::vector<uvec3>& triangles, const std::vector<uint32_t>& joined)
    : runsUp_(3 * triangles.size()) {
  std::vector<uint32_t> end(joined.size() + 1, 0);  // of the row of each vertex
  std::size_t count = 0;
  for (const uvec3& t : triangles) {
    const uvec3 v = placesOf(t, joined);
    if (isDegenerate(v)) continue;
    for (int k = 0; k < 3; ++k) ++end[std::min(v[k], v[(k + 1) % 3]) + 1];
    count += 3;
  }
  for (std::size_t i = 1; i < end.size(); ++i) end[i] += end[i - 1];
  const std::vector<uint32_t> begin = end;
  std::vector<uint64_t> entries(count);  // the higher end, then the side
  for (uint32_t t = 0; t < triangles.size(); ++t) {
    const uvec3 v = placesOf(triangles[t], joined);
    if (isDegenerate(v)) continue;
    for (uint32_t k = 0; k < 3; ++k) {
      const uint32_t a = v[int(k)], b = v[int(k + 1) % 3], side = 3 * t + k;
      runsUp_[side] = a < b;
      entries[end[std::min(a, b)]++] = uint64_t{std::max(a, b)} << 32 | side;
    }
  }
  sides_.resize(count);
  first_.reserve(count / 2 + 2);
  for (std::size_t vertex = 0; vertex < joined.size(); ++vertex) {
    std::sort(entries.begin() + begin[vertex], entries.begin() + end[vertex]);
    for (uint32_t i = begin[vertex]; i < end[vertex]; ++i) {
      if (i == begin[vertex] || entries[i] >> 32 != entries[i - 1] >> 32) first_.push_back(i);
      sides_[i] = uint32_t(entries[i]);
    }
  }
  first_.push_back(uint32_t(count));
}

}  // namespace nephroid
