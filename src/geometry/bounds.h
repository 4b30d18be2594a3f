// How much room a mesh takes.
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

// Of all vertices, in the mesh's own space.
Box boundingBox(const Mesh& mesh);

// About the middle of the bounding box.
Sphere boundingSphere(const Mesh& mesh);

// The corners of a box where it stands in the world, in the order of Box::corner; and the box along the
// world's axes around them.
std::array<vec3, 8> placedCorners(const Box& box, const Placement& placement);
Box placedBox(const Box& box, const Placement& placement);

}  // namespace nephroid
