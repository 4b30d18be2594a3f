#include "irradiance_volume/light_sphere.h"

#include <algorithm>
#include <map>
#include <utility>

namespace nephroid {
namespace {

constexpr float kGoldenRatio = 1.6180340f;

// Mirrored by the coordinate planes onto itself.
std::vector<vec3> icosahedronVertices() {
  std::vector<vec3> vertices;
  for (const float one : {-1.0f, 1.0f})
    for (const float golden : {-kGoldenRatio, kGoldenRatio}) {
      vertices.emplace_back(0, one, golden);
      vertices.emplace_back(one, golden, 0);
      vertices.emplace_back(golden, 0, one);
    }
  for (vec3& vertex : vertices) vertex = normalize(vertex);
  return vertices;
}

// Counterclockwise from outside. Neighboring vertices stand 63.4 degrees apart, others 116.6 or more.
std::vector<uvec3> icosahedronTriangles(const std::vector<vec3>& vertices) {
  const auto areNeighbors = [&](uint32_t i, uint32_t j) { return dot(vertices[i], vertices[j]) > 0.4f; };
  std::vector<uvec3> triangles;
  for (uint32_t i = 0; i < vertices.size(); ++i)
    for (uint32_t j = i + 1; j < vertices.size(); ++j)
      for (uint32_t k = j + 1; k < vertices.size(); ++k) {
        if (!areNeighbors(i, j) || !areNeighbors(j, k) || !areNeighbors(i, k)) continue;
        const bool isOutward = dot(cross(vertices[i], vertices[j]), vertices[k]) > 0;
        triangles.push_back(isOutward ? uvec3(i, j, k) : uvec3(i, k, j));
      }
  return triangles;
}

// Signed volumes between the direction and the sides: all positive inside, and in the ratio of the
// barycentric coordinates.
vec3 sideVolumes(vec3 a, vec3 b, vec3 c, vec3 direction) {
  return {dot(cross(b, c), direction), dot(cross(c, a), direction), dot(cross(a, b), direction)};
}

float least(vec3 v) {
  return std::min({v.x, v.y, v.z});
}

}  // namespace

LightSphere::LightSphere(uint32_t level) : level_(level), directions_(icosahedronVertices()) {
  std::vector<uvec3> coarse = icosahedronTriangles(directions_);
  triangles_ = coarse;
  for (uint32_t l = 0; l < level; ++l) {
    std::map<std::pair<uint32_t, uint32_t>, uint32_t> middles;
    const auto middle = [&](uint32_t i, uint32_t j) {
      const auto [found, isNew] = middles.try_emplace(std::minmax(i, j), uint32_t(directions_.size()));
      if (isNew) directions_.push_back(normalize(directions_[i] + directions_[j]));
      return found->second;
    };
    std::vector<uvec3> fine;
    for (const uvec3& t : coarse) {
      const uint32_t a = middle(t.y, t.z), b = middle(t.z, t.x), c = middle(t.x, t.y);
      for (const uvec3& part : {uvec3(t.x, c, b), uvec3(c, t.y, a), uvec3(b, a, t.z), uvec3(a, b, c)})
        fine.push_back(part);
    }
    triangles_.insert(triangles_.end(), fine.begin(), fine.end());
    coarse = std::move(fine);
  }
}

DirectionTriangle LightSphere::around(vec3 direction) const {
  uint32_t offset = 0;
  uint32_t first = 0;
  uint32_t count = 20;
  uint32_t best = 0;
  for (uint32_t level = 0;; ++level) {
    float bestLeast = -2;
    for (uint32_t t = first; t < first + count; ++t) {
      const uvec3& corners = triangles_[offset + t];
      const float inside = least(
          sideVolumes(directions_[corners.x], directions_[corners.y], directions_[corners.z], direction));
      if (inside <= bestLeast) continue;
      bestLeast = inside;
      best = t;
    }
    if (level == level_) break;
    offset += 20u << (2 * level);
    first = 4 * best;
    count = 4;
  }
  const uvec3& corners = triangles_[offset + best];
  const vec3 volumes =
      max(sideVolumes(directions_[corners.x], directions_[corners.y], directions_[corners.z], direction),
          vec3(0));
  const vec3 weights = volumes / (volumes.x + volumes.y + volumes.z);
  return {{corners.x, corners.y, corners.z}, {weights.x, weights.y, weights.z}};
}

}  // namespace nephroid
