// What is kept of a mesh to describe where rays hit it.
#pragma once

#include <vector>

#include "geometry/mesh.h"

namespace nephroid {

// All that a hit is described by, in one place of memory: a ray through a large mesh finds none of it in a
// cache.
struct TracedTriangle {
  mat3 positions;  // m
  mat3 normals;    // unit
  vec3 flatNormal;
  uint32_t patch;
};

// `patches`: the number of the smooth surface of each triangle.
std::vector<TracedTriangle> tracedTriangles(const Mesh& mesh, const std::vector<uint32_t>& patches);

// m3; infinite where the mesh is open.
float volumeOf(const Mesh& mesh);

float largestCoordinate(vec3 point);

}  // namespace nephroid
