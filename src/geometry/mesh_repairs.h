// Mends what exporters do to the faces of a mesh: seams a hair wide, faces that stand twice, and closed parts
// that are turned inside out.
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/mesh.h"
#include "geometry/mesh_edges.h"

namespace nephroid {

// Vertices at open edges that are nearer to each other than the rounding of the mesh's coordinates become one
// place; never where its own edges are as short as that. `joined` follows. False where nothing moved.
bool closeSeams(Mesh& mesh, const MeshEdges& edges, std::vector<uint32_t>& joined);

// Leaves out triangles that stand twice, and counts them. Of two that face the same way, the later one. Where
// a whole piece of the mesh has reversed copies, as in a double-sided export, those that look inward. Between
// two parts that are glued together, both. A sheet with two sides that is fixed to something else stays.
// False where there are none.
bool dropRepeatedTriangles(Mesh& mesh, const MeshEdges& edges, const std::vector<uint32_t>& joined);

// Turns closed parts whose faces look inward or run against each other, with their normals, and counts them;
// vertices that another part uses as well are doubled. With Faces::asGiven it only counts those that look
// inward. False where none was turned.
bool orientParts(Mesh& mesh, const MeshEdges& edges, Faces faces);

}  // namespace nephroid
