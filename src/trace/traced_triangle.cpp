#include "trace/traced_triangle.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace nephroid {

std::vector<TracedTriangle> tracedTriangles(const Mesh& mesh, const std::vector<uint32_t>& patches) {
  std::vector<TracedTriangle> triangles(mesh.triangles.size());
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const uvec3& c = mesh.triangles[i];
    const mat3 corners(mesh.positions[c.x], mesh.positions[c.y], mesh.positions[c.z]);
    triangles[i] = {corners, mat3(mesh.normals[c.x], mesh.normals[c.y], mesh.normals[c.z]),
                    glm::normalize(glm::cross(corners[1] - corners[0], corners[2] - corners[0])), patches[i]};
  }
  return triangles;
}

float volumeOf(const Mesh& mesh) {
  if (!mesh.isClosed) return std::numeric_limits<float>::infinity();
  double sum = 0;
  for (const uvec3& corners : mesh.triangles)
    sum += dot(glm::dvec3(mesh.positions[corners.x]),
               cross(glm::dvec3(mesh.positions[corners.y]), glm::dvec3(mesh.positions[corners.z])));
  return static_cast<float>(std::abs(sum) / 6);
}

float largestCoordinate(vec3 point) {
  const vec3 size = glm::abs(point);
  return std::max({size.x, size.y, size.z});
}

}  // namespace nephroid
