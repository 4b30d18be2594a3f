// A surface of triangles.
#pragma once

#include <string>
#include <vector>

#include "core/shared_language.h"

namespace nephroid {

// Triangles in the object's own space, counter-clockwise from outside. All arrays but `triangles` are per
// vertex.
struct Mesh {
  std::string name;
  std::vector<vec3> positions;  // m
  std::vector<vec3> normals;  // unit, exact for shapes; averaged by area from the faces where a file has none
  std::vector<vec2> texcoords;  // empty when there are none
  std::vector<uvec3> triangles;
  bool isClosed = false;          // every edge has two faces after joining equal positions
  uint32_t droppedTriangles = 0;  // triangles without an area, left out when the mesh was made
  bool isFinished = false;        // finishMesh has made it ready, as all meshes of a scene have to be
  // The surface bends between vertices as their normals say (shapes); otherwise its triangles are flat.
  bool isCurved = false;
  // The part of the surface that is of flat facets: all of a box's or a cut gem's, the ends of a cylinder's.
  // None of water, which goes on smoothly however flat it is.
  float facetedPart = 0;
  bool isFaceted() const { return facetedPart > 0.99f; }
  bool hasEdges() const { return facetedPart >= 0.1f; }  // at which light parts
};

}  // namespace nephroid
