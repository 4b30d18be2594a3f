// What a mesh is: closed or open, manifold or not, facing outward or inward; and the clean-up every mesh goes
// through once, whichever file or shape it comes from.
#pragma once

#include <string>
#include <vector>

#include "geometry/mesh.h"

namespace nephroid {

// m from the origin, of anything; squares and areas beyond it leave single precision.
inline constexpr float kLargestCoordinate = 1e9f;

struct MeshTopology {
  uint32_t boundaryEdges = 0;     // edges with one face, after joining equal positions
  uint32_t nonManifoldEdges = 0;  // edges with more than two
  uint32_t flippedEdges = 0;      // edges whose two faces run the same way: one of them is turned inside out
  double signedVolume = 0;        // m^3 (of the mesh's own space); negative when the faces look inward
  double area = 0;                // m^2
  bool isClosed() const { return boundaryEdges == 0 && nonManifoldEdges == 0; }
};

// Triangles must be within range. Triangles that touch a joined vertex twice do not count.
MeshTopology meshTopology(const Mesh& mesh);

// For every vertex, the first vertex at exactly the same position.
std::vector<uint32_t> joinEqualPositions(const std::vector<vec3>& positions);

// Makes a mesh ready for use, in place: checks that indices are in range and positions finite, merges equal
// vertices, leaves out vertices that are not used and triangles without an area (counted in
// droppedTriangles), sets isClosed and facetedPart, and makes the normals unit, or averages them by area from
// the faces at equal positions where `normals` does not hold a usable one for every vertex. Throws InputError
// beginning with `source`.
void finishMesh(Mesh& mesh, const std::string& source);

// Throws InputError beginning with `source` where a mesh is not as finishMesh leaves it: indices in range,
// lists as long as each other, positions finite, normals unit.
void checkMesh(const Mesh& mesh, const std::string& source);

}  // namespace nephroid
