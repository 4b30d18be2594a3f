// Boxes and spheres around meshes.
#pragma once

#include <array>

#include "geometry/box.h"
#include "geometry/mesh.h"
#include "geometry/placement.h"

namespace nephroid {

struct Sphere {
  vec3 center{0};  // m
  float radius = 0;
};

// The box around all vertices, in the mesh's own space.
Box boundingBox(const Mesh& mesh);

// The sphere around all vertices whose center is the middle of the bounding box.
Sphere boundingSphere(const Mesh& mesh);

// The corners of a placed box in world space, in the order of Box::corner, and the box around them along the
// world's axes.
std::array<vec3, 8> placedCorners(const Box& box, const Placement& placement);
Box placedBox(const Box& box, const Placement& placement);

}  // namespace nephroid
