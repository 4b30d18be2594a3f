// A surface of triangles.
#pragma once

#include <string>
#include <vector>

#include "core/shared_language.h"

namespace nephroid {

// What to do with closed parts of a mesh whose faces look inward: turn them, or leave them as they are, as
// cavities within the others.
enum class Faces { outward, asGiven };

// What finishMesh found in a mesh, and mended.
struct MeshFindings {
  uint32_t boundaryEdges = 0;      // with one face, after joining equal positions
  uint32_t nonManifoldEdges = 0;   // with more than two
  uint32_t flippedEdges = 0;       // whose two faces run the same way: one of them is turned inside out
  uint32_t repeatedTriangles = 0;  // that stood twice, left out
  uint32_t closedParts = 0;        // pieces that hang together by edges, with an inside
  uint32_t turnedParts = 0;        // of them, those that were turned, in whole or in part
  uint32_t turnedTriangles = 0;    // in those parts
  uint32_t inwardParts = 0;        // closed parts that look inward, and were left so
  uint32_t splitVertices = 0;      // added at creases that normals went smoothly over
};

// Triangles in the object's own space, counterclockwise from outside. All arrays but `triangles` are per
// vertex.
struct Mesh {
  std::string name;
  std::vector<vec3> positions;  // m
  std::vector<vec3> normals;  // unit, exact for shapes; averaged by area from the faces where a file has none
  std::vector<vec2> texcoords;  // empty when there are none
  std::vector<uvec3> triangles;
  bool isClosed = false;          // every edge has two faces after joining equal positions
  uint32_t droppedTriangles = 0;  // triangles without an area, left out when the mesh was made
  MeshFindings findings;
  bool isFinished = false;  // finishMesh has made it ready, as all meshes of a scene have to be
  // The surface is curved between vertices, as their normals tell (shapes); otherwise its triangles are flat.
  bool isCurved = false;
  // 0..1, the part of the surface's area that consists of flat facets: 1 for a box or a cut gem, the two ends
  // for a cylinder. 0 for water, which is smooth even where it is flat.
  float facetedPart = 0;
  bool isFaceted() const { return facetedPart > 0.99f; }
  bool hasEdges() const { return facetedPart >= 0.1f; }  // edges at which light is divided
};

}  // namespace nephroid
