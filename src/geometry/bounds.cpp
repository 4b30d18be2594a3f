#include "geometry/bounds.h"

namespace nephroid {

Box boundingBox(const Mesh& mesh) {
  Box box;
  for (const vec3& position : mesh.positions) box.include(position);
  return box;
}

Sphere boundingSphere(const Mesh& mesh) {
  Sphere sphere{boundingBox(mesh).center(), 0};
  for (const vec3& position : mesh.positions)
    sphere.radius = std::max(sphere.radius, glm::length(position - sphere.center));
  return sphere;
}

std::array<vec3, 8> placedCorners(const Box& box, const Placement& placement) {
  std::array<vec3, 8> corners;
  for (int i = 0; i < 8; ++i) corners[std::size_t(i)] = placement.point(box.corner(i));
  return corners;
}

Box placedBox(const Box& box, const Placement& placement) {
  Box placed;
  for (const vec3& corner : placedCorners(box, placement)) placed.include(corner);
  return placed;
}

}  // namespace nephroid
