// Checks and cleans meshes: closed or open, manifold or not, facing outward or inward. Every mesh is cleaned
// once, after it was read from a file or made from a shape.
#pragma once

#include <string>
#include <vector>

#include "geometry/mesh.h"

namespace nephroid {

// m from the origin, for any coordinate. Beyond it, squares and areas are too large for single precision.
inline constexpr float kLargestCoordinate = 1e9f;

struct MeshTopology {
  uint32_t boundaryEdges = 0;     // edges with one face, after joining equal positions
  uint32_t nonManifoldEdges = 0;  // edges with more than two
  uint32_t flippedEdges = 0;      // edges whose two faces run the same way: one of them is turned inside out
  double signedVolume = 0;        // m^3 (of the mesh's own space); negative when the faces look inward
  double area = 0;                // m^2
  bool isClosed() const { return boundaryEdges == 0 && nonManifoldEdges == 0; }
};

// The indices of triangles must be in range. Triangles that use a joined vertex twice do not count.
MeshTopology meshTopology(const Mesh& mesh);

// For every vertex, the first vertex at exactly the same position.
std::vector<uint32_t> joinEqualPositions(const std::vector<vec3>& positions);

// Makes a mesh ready for use. Checks that indices are in range and positions are finite. Merges equal
// vertices, also across seams that are open only by rounding. Removes vertices that are not used, triangles
// without an area (counted in droppedTriangles) and triangles that stand twice, and turns closed parts that
// look inward (both counted in findings). Sets isClosed and facetedPart. Normalizes the normals; where they
// are not usable, averages new ones by area from the faces at equal positions. Unless isCurved is set, gives
// the two sides of creases normals of their own (counted in findings). Throws InputError; the message
// begins with `source`.
void finishMesh(Mesh& mesh, const std::string& source, Faces faces = Faces::outward);

// Throws InputError, beginning with `source`, where a mesh is not in the state that finishMesh produces:
// indices in range, lists of equal length, positions finite, normals unit.
void checkMesh(const Mesh& mesh, const std::string& source);

}  // namespace nephroid
